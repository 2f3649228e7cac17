"""What a forked process does, for tests."""
import os
import signal


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
