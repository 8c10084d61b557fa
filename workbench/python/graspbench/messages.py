"""MessagePack as graspbench's controllers speak it: nil, bool, numbers, text, bytes, lists, maps, and arrays of
numpy as maps with the keys __ndarray__, data, dtype and shape. See core/base/text/message_pack.h."""

import struct

import numpy as np


def pack(value):
    """The bytes of a value."""
    parts = []
    _pack(value, parts)
    return b"".join(parts)


def _head(count, small, most_small, wide):
    if count <= most_small:
        return bytes([small | count])
    if count <= 0xFFFF:
        return struct.pack(">BH", wide, count)
    return struct.pack(">BI", wide + 1, count)


def _pack(value, parts):
    if value is None:
        parts.append(b"\xc0")
    elif isinstance(value, (bool, np.bool_)):
        parts.append(b"\xc3" if value else b"\xc2")
    elif isinstance(value, (int, np.integer)):
        parts.append(struct.pack(">Bq", 0xD3, value))
    elif isinstance(value, (float, np.floating)):
        parts.append(struct.pack(">Bd", 0xCB, value))
    elif isinstance(value, str):
        text = value.encode()
        parts.append(_head(len(text), 0xA0, 31, 0xDA))
        parts.append(text)
    elif isinstance(value, bytes):
        parts.append(struct.pack(">BI", 0xC6, len(value)))
        parts.append(value)
    elif isinstance(value, (list, tuple)):
        parts.append(_head(len(value), 0x90, 15, 0xDC))
        for item in value:
            _pack(item, parts)
    elif isinstance(value, dict):
        parts.append(_head(len(value), 0x80, 15, 0xDE))
        for key, item in value.items():
            _pack(key, parts)
            _pack(item, parts)
    elif isinstance(value, np.ndarray):
        array = np.ascontiguousarray(value)
        array = array.astype(array.dtype.newbyteorder("<"), copy=False)
        _pack({b"__ndarray__": True, b"data": array.tobytes(), b"dtype": array.dtype.str,
               b"shape": list(value.shape)}, parts)
    else:
        raise TypeError(f"a {type(value).__name__} cannot be sent; expected numbers, texts, lists, "
                        "dicts or numpy arrays")


def unpack(data):
    """The value of bytes that pack() or graspbench wrote."""
    value, end = _unpack(memoryview(data), 0)
    if end != len(data):
        raise ValueError("bytes after the value")
    return value


_NUMBERS = {0xCA: ">f", 0xCB: ">d", 0xCC: ">B", 0xCD: ">H", 0xCE: ">I", 0xCF: ">Q",
            0xD0: ">b", 0xD1: ">h", 0xD2: ">i", 0xD3: ">q"}
_COUNTS = {0xC4: ">B", 0xC5: ">H", 0xC6: ">I", 0xD9: ">B", 0xDA: ">H", 0xDB: ">I",
           0xDC: ">H", 0xDD: ">I", 0xDE: ">H", 0xDF: ">I"}


def _unpack(data, at):
    head = data[at]
    at += 1
    if head < 0x80:
        return head, at
    if head >= 0xE0:
        return head - 256, at
    if head < 0x90:
        return _unpack_map(data, at, head & 0x0F)
    if head < 0xA0:
        return _unpack_list(data, at, head & 0x0F)
    if head < 0xC0:
        end = at + (head & 0x1F)
        return str(data[at:end], "utf-8"), end
    if head in (0xC0, 0xC2, 0xC3):
        return {0xC0: None, 0xC2: False, 0xC3: True}[head], at
    if head in _NUMBERS:
        form = _NUMBERS[head]
        return struct.unpack_from(form, data, at)[0], at + struct.calcsize(form)
    if head not in _COUNTS:
        raise ValueError(f"byte {head:#x} is no MessagePack that graspbench writes")
    form = _COUNTS[head]
    count = struct.unpack_from(form, data, at)[0]
    at += struct.calcsize(form)
    if head >= 0xDE:
        return _unpack_map(data, at, count)
    if head >= 0xDC:
        return _unpack_list(data, at, count)
    part = data[at:at + count]
    return (str(part, "utf-8") if head >= 0xD9 else bytes(part)), at + count


def _unpack_list(data, at, count):
    items = []
    for _ in range(count):
        item, at = _unpack(data, at)
        items.append(item)
    return items, at


def _unpack_map(data, at, count):
    items = {}
    for _ in range(count):
        key, at = _unpack(data, at)
        items[key], at = _unpack(data, at)
    if b"__ndarray__" in items:
        array = np.frombuffer(items[b"data"], np.dtype(items[b"dtype"])).reshape(items[b"shape"])
        return array, at
    return items, at
