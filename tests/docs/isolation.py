"""A network of the test's own, where the system allows it: pages name fixed ports, and tests run side by side."""
import ctypes
import fcntl
import os
import pathlib
import socket
import struct

NEW_USER, NEW_NETWORK = 0x10000000, 0x40000000  # CLONE_NEWUSER, CLONE_NEWNET of <sched.h>
GET_FLAGS, SET_FLAGS, UP = 0x8913, 0x8914, 1    # SIOCGIFFLAGS, SIOCSIFFLAGS of <linux/sockios.h>, IFF_UP


def own_network():
    """Moves this process into a network with a loopback and nothing else. False where that is forbidden: then the ports
    are the machine's, and ctest runs such tests one after the other (RESOURCE_LOCK)."""
    user, group = os.getuid(), os.getgid()
    if ctypes.CDLL(None, use_errno=True).unshare(NEW_USER | NEW_NETWORK) != 0:
        return False
    pathlib.Path("/proc/self/setgroups").write_text("deny")
    pathlib.Path("/proc/self/uid_map").write_text(f"{user} {user} 1")
    pathlib.Path("/proc/self/gid_map").write_text(f"{group} {group} 1")
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as any_socket:
        name = struct.pack("16sh", b"lo", 0)
        flags = struct.unpack("16sh", fcntl.ioctl(any_socket, GET_FLAGS, name))[1]
        fcntl.ioctl(any_socket, SET_FLAGS, struct.pack("16sh", b"lo", flags | UP))
    return True


def listening_ports():
    """The ports of this network on which somebody listens."""
    ports = set()
    for table in ("/proc/self/net/tcp", "/proc/self/net/tcp6"):
        if os.path.exists(table):
            for line in pathlib.Path(table).read_text().splitlines()[1:]:
                fields = line.split()
                if fields[3] == "0A":  # TCP_LISTEN
                    ports.add(int(fields[1].rpartition(":")[2], 16))
    return ports
