# SPDX-License-Identifier: BSD-3-Clause
"""A client of WebSockets (RFC 6455), as small as tests need it."""

import base64
import json
import os
import socket
import struct
from urllib.parse import urlsplit

TEXT, BINARY, CLOSE, PING, PONG = 1, 2, 8, 9, 10


class Refused(Exception):
    """The server's answer to a request that it does not upgrade."""


class WebSocket:
    def __init__(self, url, path="/live", patience_s=60, **headers):
        address = urlsplit(url)
        self.socket = socket.create_connection((address.hostname, address.port), patience_s)
        lines = {"Host": address.netloc, "Upgrade": "websocket", "Connection": "Upgrade", "Sec-WebSocket-Version": "13",
                 "Sec-WebSocket-Key": base64.b64encode(os.urandom(16)).decode(), **headers}
        head = "".join(f"{name}: {value}\r\n" for name, value in lines.items())
        self.socket.sendall(f"GET {path}?{address.query} HTTP/1.1\r\n{head}\r\n".encode())
        self.received = b""
        while b"\r\n\r\n" not in self.received:
            if not (part := self.socket.recv(65536)):
                break
            self.received += part
        answer, _, self.received = self.received.partition(b"\r\n\r\n")
        self.answer = answer.decode()
        if b" 101 " not in answer.split(b"\r\n")[0]:
            self.close()
            raise Refused(answer.split(b"\r\n")[0].decode())
        self.asked = 0
        self.pushed = []

    def take(self, count):
        while len(self.received) < count:
            if not (part := self.socket.recv(1 << 20)):
                raise ConnectionError("the server has closed the connection")
            self.received += part
        taken, self.received = self.received[:count], self.received[count:]
        return taken

    def send(self, data, kind=TEXT):
        mask = b"\0\0\0\0"
        size = len(data)
        head = struct.pack("!BB", 0x80 | kind, 0x80 | size) if size < 126 else (
            struct.pack("!BBH", 0x80 | kind, 0x80 | 126, size) if size < 65536 else
            struct.pack("!BBQ", 0x80 | kind, 0x80 | 127, size))
        self.socket.sendall(head + mask + data)

    def receive(self):
        """The next text, as JSON."""
        while (message := self.receive_message())[0] != TEXT:
            pass
        return json.loads(message[1])

    def receive_message(self):
        """(TEXT or BINARY, bytes)."""
        while True:
            first, second = self.take(2)
            size = second & 127
            if size >= 126:
                size = int.from_bytes(self.take(2 if size == 126 else 8), "big")
            data = self.take(size)
            if first & 15 == PING:
                self.send(data, PONG)
            elif first & 15 == CLOSE:
                raise ConnectionError("the server has closed the WebSocket")
            elif first & 15 in (TEXT, BINARY):
                return first & 15, data

    def ask(self, what, **members):
        """The reply to a request; what is pushed meanwhile is in `pushed`."""
        self.asked += 1
        self.send(json.dumps({"id": self.asked, "ask": what, **members}).encode())
        while (reply := self.receive()).get("id") != self.asked:
            self.pushed.append(reply)
        return reply

    def receive_until(self, is_it):
        """The first text, pushed before or from now on, of which `is_it` is true."""
        for pushed in self.pushed:
            if is_it(pushed):
                return pushed
        while not is_it(pushed := self.receive()):
            pass
        return pushed

    def close(self):
        self.socket.close()
