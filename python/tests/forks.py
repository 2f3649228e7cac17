"""What a forked process does, for tests."""
import os
import signal
import threading
import unittest

# It ends processes that start threads after a fork.
if "libtsan" in os.environ.get("LD_PRELOAD", ""):
    unless_thread_sanitizer = unittest.skip("the thread sanitizer knows no forks")
else:
    unless_thread_sanitizer = lambda test: test  # noqa: E731


def in_child(work):
    """Returns what work() returns in a process that is forked, as text; fails if that hangs."""
    reading, writing = os.pipe()
    child = os.fork()
    if child == 0:  # a test's exceptions and clean-up are none of the child's
        try:
            signal.alarm(60)
            os.write(writing, str(work()).encode())
        except BaseException as error:
            os.write(writing, f"{type(error).__name__}: {error}".encode())
        finally:
            os._exit(0)
    os.close(writing)
    with os.fdopen(reading) as file:
        text = file.read()
    status = os.waitpid(child, 0)[1]
    return text if status == 0 else f"ended by signal {status}"


def in_children_while(busy, work):
    """The different texts that work() returns in ten processes that are forked while a thread here calls busy() on and on."""
    stop = threading.Event()

    def keep_busy():
        while not stop.is_set():
            busy()

    thread = threading.Thread(target=keep_busy)
    thread.start()
    try:
        return {in_child(work) for _ in range(10)}
    finally:
        stop.set()
        thread.join()
