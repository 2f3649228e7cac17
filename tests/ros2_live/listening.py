"""What a program says, line by line, heard on a thread of its own: for tests."""
import threading


class Listening:
    def __init__(self, stream):
        self.lines, self.ended, self.arrived = [], False, threading.Condition()
        self.thread = threading.Thread(target=self.listen, args=(stream,), daemon=True)
        self.thread.start()

    def listen(self, stream):
        for line in stream:
            with self.arrived:
                self.lines.append(line.rstrip("\n"))
                self.arrived.notify_all()
        with self.arrived:
            self.ended = True
            self.arrived.notify_all()

    def since(self, count):
        """The lines that came after the first so many."""
        with self.arrived:
            return self.lines[count:]

    def count(self):
        with self.arrived:
            return len(self.lines)

    def waits_for(self, is_it, times=1, since=0, timeout=60.0):
        """Whether lines for which is_it is true were said so many times, after the first `since` lines, or are in time."""
        seen, found = since, 0

        def is_there():
            nonlocal seen, found
            found += sum(map(is_it, self.lines[seen:]))
            seen = len(self.lines)
            return found >= times or self.ended
        with self.arrived:
            self.arrived.wait_for(is_there, timeout)
            return found >= times

    def all(self):
        """All lines, once the program has ended."""
        self.thread.join()
        return self.lines
