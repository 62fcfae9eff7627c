"""Plain bytes to a controller, for what no vendor's client does: lines of ASCII, and frames of TMCL that must not
be sent twice."""

import collections
import os
import socket
import termios
import tty

TIMEOUT_S = 5

Reply = collections.namedtuple("Reply", "status value")


class Wire:
    """A connection to an endpoint as the server names it. Fails with `OSError` when the other end has gone."""

    def __init__(self, endpoint):
        kind, place = endpoint.split(":", 1)
        self._socket = self._terminal = None
        if kind == "tcp":
            host, port = place.split(":")
            self._socket = socket.create_connection((host, int(port)), TIMEOUT_S)
            self._socket.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
        else:
            self._terminal = os.open(place, os.O_RDWR | os.O_NOCTTY)
            tty.setraw(self._terminal)
            termios.tcflush(self._terminal, termios.TCIOFLUSH)

    def send(self, data):
        if self._socket:
            self._socket.sendall(data)
        else:
            os.write(self._terminal, data)

    def receive(self, most):
        data = self._socket.recv(most) if self._socket else os.read(self._terminal, most)
        if not data:
            raise ConnectionError("the other end has gone")
        return data

    def close(self):
        if self._socket:
            self._socket.close()
        else:
            os.close(self._terminal)

    def __enter__(self):
        return self

    def __exit__(self, kind, error, trace):
        self.close()


class Lines(Wire):
    """Performax and Commander: a command and its reply are lines that end with a carriage return."""

    def ask(self, command):
        self.send(f"{command}\r".encode())
        reply = b""
        while not reply.endswith(b"\r"):
            reply += self.receive(256)
        return reply[:-1].decode()

    def order(self, command):
        """A command that must be answered with `OK`."""
        reply = self.ask(command)
        assert reply == "OK", f"{command}: {reply}"

    def orders(self, text):
        for command in text.split():
            self.order(command)

    def number(self, command):
        return int(self.ask(command))


class Frames(Wire):
    """TMCL: nine bytes there, nine bytes back."""

    def ask(self, opcode, kind=0, motor=0, value=0):
        body = bytes([1, opcode, kind, motor]) + (value & 0xFFFF_FFFF).to_bytes(4, "big")
        self.send(body + bytes([sum(body) & 0xFF]))
        reply = b""
        while len(reply) < 9:
            reply += self.receive(9 - len(reply))
        return Reply(reply[2], int.from_bytes(reply[4:8], "big", signed=True))

    def order(self, opcode, kind=0, motor=0, value=0):
        """A command that must be accepted; gives its value."""
        reply = self.ask(opcode, kind, motor, value)
        assert reply.status in (100, 101), (opcode, kind, motor, value, reply)
        return reply.value
