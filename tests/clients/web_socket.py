"""A WebSocket client (RFC 6455) on the standard library: all that another program needs to speak to sculptd as a browser does."""

import base64
import os

TEXT, BINARY, CLOSE, PING, PONG = 1, 2, 8, 9, 10


class Refused(Exception):
    """The server did not accept the upgrade; `status` is its HTTP status."""

    def __init__(self, head):
        super().__init__(head)
        self.status = int(head.split()[1])


class WebSocket:
    def __init__(self, connected, host, path="/v1/ws", origin=None):
        self.socket, self.stream = connected, connected.makefile("rb")
        key = base64.b64encode(os.urandom(16)).decode()
        self.socket.sendall((f"GET {path} HTTP/1.1\r\nHost: {host}\r\nUpgrade: websocket\r\nConnection: Upgrade\r\n"
                             f"Sec-WebSocket-Key: {key}\r\nSec-WebSocket-Version: 13\r\n"
                             + (f"Origin: {origin}\r\n" if origin else "") + "\r\n").encode())
        head = "".join(iter(lambda: self.stream.readline().decode(), "\r\n"))
        if " 101 " not in head:
            raise Refused(head)

    def send(self, payload, kind=TEXT, pieces=1):
        """One message, in so many frames."""
        size = -(-len(payload) // pieces) or 1
        parts = [payload[at:at + size] for at in range(0, len(payload), size)] or [b""]
        for number, part in enumerate(parts):
            head = bytes([(0x80 if number == len(parts) - 1 else 0) | (kind if number == 0 else 0)])
            length = len(part)
            head += bytes([0x80 | length]) if length < 126 else b"\xfe" + length.to_bytes(2, "big") if length < 1 << 16 else b"\xff" + length.to_bytes(8, "big")
            mask = os.urandom(4)
            self.socket.sendall(head + mask + bytes(byte ^ mask[at % 4] for at, byte in enumerate(part)))

    def receive(self):
        """(kind, payload) of the next message, whose frames are put together."""
        message, kind = b"", None
        while True:
            first, second = self.stream.read(2)
            length = second & 0x7f
            if length >= 126:
                length = int.from_bytes(self.stream.read(2 if length == 126 else 8), "big")
            message += self.stream.read(length)
            kind = kind or first & 0x0f
            if first & 0x80:
                return kind, message

    def close(self):
        self.stream.close()
        self.socket.close()
