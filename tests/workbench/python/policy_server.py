"""A policy server for tests, written from public descriptions alone: RFC 6455 (websockets), the MessagePack
specification, and the messages that openpi's clients and servers exchange. It shares no code with the program.

openpi: the server sends a map of metadata; each binary message of the client is an observation, each answer a map
with `actions`. Arrays are maps with the keys __ndarray__, data, dtype, shape as bytes. A text is a traceback, after
which the server closes with 1011."""

import base64
import hashlib
import socket
import struct
import threading
import traceback

import numpy as np

GUID = b"258EAFA5-E914-47DA-95CA-C5AB0DC85B11"
TEXT, BINARY, CLOSE, PING, PONG = 1, 2, 8, 9, 10


def encode(value):
    """MessagePack as msgpack-python with openpi's default hook writes it."""
    if value is None:
        return b"\xc0"
    if value is True or value is False:
        return b"\xc3" if value else b"\xc2"
    if isinstance(value, int):
        return struct.pack("B", value) if 0 <= value < 128 else b"\xd3" + struct.pack(">q", value)
    if isinstance(value, float):
        return b"\xcb" + struct.pack(">d", value)
    if isinstance(value, str):
        data = value.encode()
        return (struct.pack("B", 0xA0 | len(data)) if len(data) < 32 else b"\xdb" + struct.pack(">I", len(data))) + data
    if isinstance(value, bytes):
        if len(value) < 256:
            return b"\xc4" + struct.pack("B", len(value)) + value
        return b"\xc6" + struct.pack(">I", len(value)) + value
    if isinstance(value, np.ndarray):
        return encode({b"__ndarray__": True, b"data": value.tobytes(), b"dtype": value.dtype.str,
                       b"shape": list(value.shape)})
    if isinstance(value, np.generic):
        return encode({b"__npgeneric__": True, b"data": value.item(), b"dtype": value.dtype.str})
    if isinstance(value, (list, tuple)):
        return b"\xdc" + struct.pack(">H", len(value)) + b"".join(map(encode, value))
    return (b"\xde" + struct.pack(">H", len(value)) +
            b"".join(encode(key) + encode(item) for key, item in value.items()))


class Decoder:
    def __init__(self, data):
        self.data, self.at = data, 0

    def take(self, count):
        part = self.data[self.at:self.at + count]
        assert len(part) == count, "the message ends too early"
        self.at += count
        return part

    def number(self, form):
        return struct.unpack(">" + form, self.take(struct.calcsize(form)))[0]

    def items(self, count):
        return [self.value() for _ in range(count)]

    def map(self, count):
        found = {}
        for _ in range(count):
            key = self.value()
            found[key] = self.value()
        if b"__ndarray__" in found:
            return np.ndarray(buffer=found[b"data"], dtype=np.dtype(found[b"dtype"]), shape=found[b"shape"])
        return found

    def value(self):
        head = self.number("B")
        if head <= 0x7F:
            return head
        if head <= 0x8F:
            return self.map(head - 0x80)
        if head <= 0x9F:
            return self.items(head - 0x90)
        if head <= 0xBF:
            return self.take(head - 0xA0).decode()
        if head >= 0xE0:
            return head - 0x100
        if head in (0xC0, 0xC2, 0xC3):
            return (None, None, False, True)[head - 0xC0]
        if head in (0xC4, 0xC5, 0xC6):
            return bytes(self.take(self.number("BHI"[head - 0xC4])))
        if 0xCA <= head <= 0xD3:
            return self.number("fdBHIQbhiq"[head - 0xCA])
        if 0xD9 <= head <= 0xDB:
            return self.take(self.number("BHI"[head - 0xD9])).decode()
        if head in (0xDC, 0xDD):
            return self.items(self.number("HI"[head - 0xDC]))
        assert head in (0xDE, 0xDF), f"byte {head:#x} is not supported"
        return self.map(self.number("HI"[head - 0xDE]))


class Gone(Exception):
    pass


class Connection:
    """One client; frames are not fragmented where this side writes them."""

    def __init__(self, plug):
        self.plug, self.opened = plug, False

    def take(self, count):
        data = b""
        while len(data) < count:
            part = self.plug.recv(count - len(data))
            if not part:
                raise Gone
            data += part
        return data

    def shake_hands(self, accept=True):
        request = b""
        while not request.endswith(b"\r\n\r\n"):
            request += self.take(1)
        lines = request.decode().split("\r\n")
        fields = {name.lower(): value.strip() for name, _, value in (line.partition(":") for line in lines[1:])}
        self.path = lines[0].split()[1]
        if not accept:
            self.plug.sendall(b"HTTP/1.1 503 Service Unavailable\r\nContent-Length: 0\r\n\r\n")
            raise Gone
        assert fields["upgrade"].lower() == "websocket" and fields["sec-websocket-version"] == "13", fields
        key = base64.b64encode(hashlib.sha1(fields["sec-websocket-key"].encode() + GUID).digest()).decode()
        self.plug.sendall(("HTTP/1.1 101 Switching Protocols\r\nUpgrade: websocket\r\nConnection: Upgrade\r\n"
                           f"Sec-WebSocket-Accept: {key}\r\n\r\n").encode())

    def send(self, data, code=BINARY, first=True, last=True):
        head = struct.pack("B", (0x80 if last else 0) | (code if first else 0))
        if len(data) < 126:
            head += struct.pack("B", len(data))
        elif len(data) < 65536:
            head += b"\x7e" + struct.pack(">H", len(data))
        else:
            head += b"\x7f" + struct.pack(">Q", len(data))
        self.plug.sendall(head + data)

    def receive(self):
        """The next message; pings and pongs are met on the way."""
        message = b""
        while True:
            first, second = self.take(2)
            assert second & 0x80, "a client's frames are masked"
            length = second & 0x7F
            if length == 126:
                length = struct.unpack(">H", self.take(2))[0]
            elif length == 127:
                length = struct.unpack(">Q", self.take(8))[0]
            mask = np.frombuffer(self.take(4), np.uint8)
            data = np.frombuffer(self.take(length), np.uint8)
            data = (data ^ np.resize(mask, length)).tobytes() if length else b""
            code = first & 0x0F
            if code == CLOSE:
                self.send(data, CLOSE)
                raise Gone
            if code in (PING, PONG):
                self.pongs = getattr(self, "pongs", 0) + (code == PONG)
                continue
            message += data
            if first & 0x80:
                return message


class Server:
    """infer(observation) -> dict, as openpi's policies; other behaviours replace `talk`."""

    def __init__(self, infer=None, metadata=None, talk=None, accept=True):
        self.infer, self.metadata, self.accept = infer, metadata or {}, accept
        self.talk = talk or self.serve
        self.observations, self.num_connections, self.errors = [], 0, []
        self.door = socket.create_server(("127.0.0.1", 0))
        self.address = f"ws://127.0.0.1:{self.door.getsockname()[1]}"
        threading.Thread(target=self.open, daemon=True).start()

    def open(self):
        while True:
            try:
                plug, _ = self.door.accept()
            except OSError:
                return
            self.num_connections += 1
            threading.Thread(target=self.meet, args=(Connection(plug),), daemon=True).start()

    def meet(self, connection):
        try:
            connection.shake_hands(self.accept)
            self.talk(connection)
        except (Gone, OSError):
            pass
        except Exception:
            self.errors.append(traceback.format_exc())
        finally:
            connection.plug.close()

    def serve(self, connection):
        connection.send(encode(self.metadata))
        while True:
            observation = Decoder(connection.receive()).value()
            self.observations.append(observation)
            try:
                action = dict(self.infer(observation))
            except Exception:
                connection.send(traceback.format_exc().encode(), TEXT)
                connection.send(struct.pack(">H", 1011), CLOSE)
                return
            action["server_timing"] = {"infer_ms": 0.1}
            connection.send(encode(action))

    def close(self):
        self.door.close()
