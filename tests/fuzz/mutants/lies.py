"""Numbers, texts and cuts that a file of any format may hold."""
import math

FLOATS = [math.nan, math.inf, -math.inf, -1.0, -0.0, 0.0, 1e-310, 3.4e38, 1e308, 2.0**31, 2.0**63, -2.0**63, 0.5, 65535.0]
WHOLES = [0, 1, -1, 2, 127, 128, 255, 256, 32767, 32768, 65535, 65536, 2**31 - 1, 2**31, 2**32 - 1, 2**63 - 1, 2**64]
TEXTS = ['', ' ', '\x00', '..', '/etc/passwd', '/dev/zero', '../../../../etc/passwd', 'a' * 5000, '\u202e', '\x1b]0;x\x07', '%s%n', 'nan',
         '1e999', '-', '0x10', '1' * 400]


def numbers(r):
    return r.choice([r.choice(FLOATS), float(r.choice(WHOLES)), r.uniform(-10, 10)])


def words(r):
    return r.choice(TEXTS + [repr(f) for f in FLOATS] + [str(w) for w in WHOLES])


def cut(r, data):
    """What every format must stand: cut off, a byte changed, a part twice."""
    if not data:
        return data
    at = r.randrange(len(data))
    return r.choice([data[:at], data[:at] + bytes([r.randrange(256)]) + data[at + 1:], data[:at] + data[at // 2:]])


def write(folder, name, content):
    path = folder / name
    path.write_bytes(content)
    return path
