"""Damaged and malicious files, made from the formats' specifications alone (c3d.org, numpy.lib.format, pickletools,
glTF 2.0, COLLADA 1.4, PLY, STL, OBJ, URDF, MJCF, YAML 1.2, JSON, HDF5, MCAP, ZIP): whoever wrote this had not looked at
the readers.

make(kind, seed, folder) writes one file into the folder, with what it names beside it, and returns its path."""
import base64, json, math, pickletools, random, re, struct, sys
from pathlib import Path
import xml.etree.ElementTree as xml
from containers import container, demonstrations
from hands import collada, mjcf, small_hand, urdf
from lies import FLOATS, TEXTS, WHOLES, cut, numbers, words, write

# --- C3D: groups and parameters with types, dimensions and values
def c3d(r, _cases, folder):
    points, frames, channels, per_frame = 3, 20, 2, 2
    groups = [(1, b'POINT', [('USED', 2, [], [points]), ('SCALE', 4, [], [-0.1]), ('RATE', 4, [], [100.0]), ('FRAMES', 2, [], [frames]),
                             ('DATA_START', 2, [], [0]), ('LABELS', -1, [4, points], b'p1  p2  p3  '), ('UNITS', -1, [2], b'mm')]),
              (2, b'ANALOG', [('USED', 2, [], [channels]), ('LABELS', -1, [4, channels], b'a1  a2  '), ('SCALE', 4, [channels], [1.0, 1.0]),
                              ('OFFSET', 2, [channels], [0, 0]), ('GEN_SCALE', 4, [], [1.0]), ('RATE', 4, [], [200.0])]),
              (3, b'EVENT', [('USED', 2, [], [2]), ('TIMES', 4, [2, 2], [0.0, 0.1, 0.0, 0.15]), ('LABELS', -1, [4, 2], b'aaaabbbb'),
                             ('CONTEXTS', -1, [4, 2], b'LeftLeft')]),
              (4, b'TRIAL', [('ACTUAL_START_FIELD', 2, [2], [1, 0]), ('ACTUAL_END_FIELD', 2, [2], [frames, 0])])]
    header = {1: points, 2: channels * per_frame, 3: 1, 4: frames, 5: 10, 8: 0, 9: per_frame}
    floats = {6: -0.1, 10: 100.0}
    lies = [r.randrange(9) for _ in range(r.randint(1, 3))]
    for lie in lies:
        group = r.choice(groups)
        i = r.randrange(len(group[2]))
        name, kind, dims, values = group[2][i]
        if lie == 0:  # another type for the same bytes
            kind = r.choice([-1, 1, 2, 4, 0, 3, -2, 8])
        elif lie == 1:
            dims = [r.choice([0, 1, 2, 3, 127, 128, 255]) for _ in range(r.choice([0, 1, 2, 3, 7]))]
        elif lie in (2, 3, 4) and kind != -1:
            if kind == 4 or lie == 4:
                kind, values = 4, [numbers(r) for _ in values]
            else:
                values = [r.choice([0, -1, 1, 2, 32767, -32768, 100]) for _ in values]
        elif lie == 5:
            name = r.choice([name * 30, '', 'USED', name.lower(), name + '2'])
        elif lie == 6:
            header[r.choice(list(header))] = r.choice([0, 1, 2, 255, 256, 32767, 65535])
        elif lie == 7:
            floats[r.choice(list(floats))] = numbers(r)
        else:
            values = values[:0] if r.random() < 0.5 else values * 40
        group[2][i] = (name, kind, dims, values)

    def value_bytes(kind, values):
        if isinstance(values, bytes):
            return values
        if kind == 4:
            return b''.join(struct.pack('<f', max(min(v, 3.4e38), -3.4e38) if v == v and not math.isinf(v) else v) for v in values)
        return b''.join(struct.pack('<h', max(-32768, min(32767, int(v) if v == v and not math.isinf(v) else 0))) for v in values)

    section = b''
    for number, title, parameters in groups:
        entry = struct.pack('<bb', len(title), -number) + title
        entry += struct.pack('<hb', 3, 0)
        section += entry
        for name, kind, dims, values in parameters:
            text = name.encode('latin-1', 'replace')[:127]
            body = struct.pack('<bB', max(-128, min(127, kind)), min(len(dims), 255)) + bytes(d & 255 for d in dims) + value_bytes(kind, values) + b'\0'
            offset = 2 + len(body) if r.random() > 0.03 else r.choice([0, 1, 2, 32767, -5])
            section += struct.pack('<bb', r.choice([1, 1, 1, -1]) * len(text), number if r.random() > 0.03 else r.choice([0, 9, 127])) + text
            section += struct.pack('<h', max(-32768, min(32767, offset))) + body
    blocks = (4 + len(section) + 511) // 512
    start = 2 + blocks
    head = bytearray(512)
    head[0:2] = bytes([2, 80])
    header[8] = header[8] or start
    for word, value in header.items():
        struct.pack_into('<H', head, 2 * word, value & 65535)
    for word, value in floats.items():
        struct.pack_into('<f', head, 2 * word, value if abs(value) < 3.4e38 or value != value or math.isinf(value) else 3.4e38)
    processor = 84 if r.random() > 0.1 else r.choice([0, 83, 85, 86, 255])
    parameters = (bytes([1, 80, blocks if r.random() > 0.05 else r.choice([0, 1, 255]), processor]) + section).ljust(512 * blocks, b'\0')
    data = b''
    for f in range(frames):
        for p in range(points):
            row = [numbers(r) if r.random() < 0.02 else 100.0 * p + f for _ in range(3)]
            data += struct.pack('<4f', *[v if abs(v) < 3.4e38 or v != v or math.isinf(v) else 0.0 for v in row], r.choice([0.0, 1.0, -1.0]))
        data += struct.pack('<4f', *[float(f)] * (channels * per_frame))
    content = bytes(head) + parameters + data
    return write(folder, 'mutant.c3d', cut(r, content) if r.random() < 0.15 else content)


# --- numpy: headers and pickles
def npy(r, cases, folder):
    good = r.choice(sorted(cases.glob('grasps_dex*/good_*.npy'))).read_bytes()
    size = struct.unpack('<H', good[8:10])[0]
    payload = good[10 + size:]
    choice = r.random()
    header = "{'descr': '|O', 'fortran_order': False, 'shape': (), }"
    if choice < 0.3:
        header = "{'descr': %s, 'fortran_order': %s, 'shape': %s, }" % (
            r.choice(["'|O'", "'<f8'", "'>f4'", "'<i8'", "'|S0'", "'<U99999999'", "[('a', '<f8')]", "''", "'<f%d'" % r.choice(WHOLES)]),
            r.choice(['False', 'True', 'None', '7']),
            r.choice(['()', '(%d,)' % r.choice(WHOLES), '(%d, %d)' % (r.choice(WHOLES), r.choice(WHOLES)), '(' + '1,' * 500 + ')', '(-1,)', '(1e9,)', '0']))
    elif choice < 0.7:
        payload = mutate_pickle(r, payload)
    else:
        payload = make_pickle(r)
    text = header.encode().ljust(r.choice([54, 117, 400]) , b' ') + b'\n'
    length = len(text) if r.random() > 0.1 else r.choice([0, 1, 65535])
    content = b'\x93NUMPY' + bytes([r.choice([1, 1, 1, 2, 3, 0, 255]), 0]) + struct.pack('<H', length) + text + payload
    return write(folder, 'mutant.npy', cut(r, content) if r.random() < 0.2 else content)


def mutate_pickle(r, data):
    try:
        opcodes = [(op, arg, at) for op, arg, at in pickletools.genops(data)]
    except Exception:
        return cut(r, data)
    out = bytearray(data)
    for _ in range(r.randint(1, 4)):
        op, arg, at = r.choice(opcodes)
        if op.name in ('BININT', 'BINUNICODE', 'BINBYTES', 'LONG_BINGET', 'LONG_BINPUT'):
            struct.pack_into('<I', out, at + 1, r.choice([w for w in WHOLES if 0 <= w < 2**32]))
        elif op.name in ('BININT1', 'BINGET', 'BINPUT', 'SHORT_BINUNICODE', 'SHORT_BINBYTES', 'PROTO'):
            out[at + 1] = r.choice([0, 1, 2, 127, 255])
        elif op.name == 'BINFLOAT':
            struct.pack_into('>d', out, at + 1, numbers(r))
        elif op.name == 'FRAME':
            struct.pack_into('<Q', out, at + 1, r.choice([w for w in WHOLES if 0 <= w < 2**64]))
        else:
            out[at] = ord(r.choice(['0', '2', 'a', 'e', 's', 'u', 't', ')', ']', '}', '(', 'N', 'R', 'b', '.', '\x94', 'h']))
    return bytes(out)


def make_pickle(r):
    reconstruct = b'cnumpy.core.multiarray\n_reconstruct\n(cnumpy\nndarray\n(K\x00tC\x01btR'

    def array(shape, code, raw):
        sizes = b'(' + b''.join(b'\x8a\x09' + struct.pack('<q', s) + b'\0' for s in shape) + b't'
        dtype = b'cnumpy\ndtype\n(X' + struct.pack('<I', len(code)) + code + b'\x89\x88tR(K\x03X\x01\0\0\0<NNNJ\xff\xff\xff\xffJ\xff\xff\xff\xffK\0tb'
        return reconstruct + b'(K\x01' + sizes + dtype + b'\x89B' + struct.pack('<I', len(raw)) + raw + b'tb'
    raw = struct.pack('<7d', *[numbers(r) for _ in range(7)])
    kind = r.randrange(7)
    if kind == 0:  # depth
        depth = r.choice([10, 1000, 100000])
        return b'\x80\x04' + b']' * depth + b'a' * (depth - 1) + b'.'
    if kind == 1:  # one list that holds itself
        return b'\x80\x04]\x94h\x00a.'
    if kind == 2:  # doubling by memo
        body = b']q\x00'
        for i in range(r.choice([5, 30, 250])):
            body += b'](h' + bytes([i]) + b'h' + bytes([i]) + b'eq' + bytes([i + 1])
        return b'\x80\x04' + body + b'.'
    if kind == 3:  # what would run a command
        return r.choice([b"cos\nsystem\n(S'touch ran'\ntR.", b'\x80\x04cbuiltins\neval\n(X\x03\0\0\0' + b'1+1tR.', b"cposix\nsystem\n(S'touch ran'\ntR."])
    shape = [r.choice([0, 1, 7, 10**6, 10**12, 2**62, -1]) for _ in range(r.choice([0, 1, 2, 3]))]
    keys = ['pregrasp_qpos', 'grasp_qpos', 'squeeze_qpos', 'obj_scale', 'scene_path', 'qpos', 'scale', 'grasp']
    value = array(shape, r.choice([b'f8', b'f4', b'i8', b'f2', b'O8', b'f%d' % r.choice([0, 3, 16, 99])]), raw)
    if kind == 4:
        return b'\x80\x03' + value + b'.'
    body = b'\x80\x03}('
    for key in keys:
        body += b'X' + struct.pack('<I', len(key)) + key.encode() + (value if r.random() < 0.7 else b'G' + struct.pack('>d', numbers(r)))
    body += b'u.'
    if kind == 5:
        return body
    rows = r.choice([100, 20000])  # one array named many times
    many = value + b'q\x07]q\x08(' + b'h\x07' * rows + b'e'
    body = b'\x80\x03}('
    for key in keys:
        body += b'X' + struct.pack('<I', len(key)) + key.encode() + (many if key == keys[0] else b'h\x08')
    return body + b'u.'


# --- JSON and glTF
def change_json(r, value):
    paths = []

    def walk(node, path):
        paths.append(path)
        for key, item in (node.items() if isinstance(node, dict) else enumerate(node) if isinstance(node, list) else []):
            walk(item, path + [key])
    walk(value, [])
    path = r.choice(paths[1:] or [[]])
    if not path:
        return r.choice([[], {}, None, 1e308])
    node = value
    for key in path[:-1]:
        node = node[key]
    old = node[path[-1]]
    kind = r.randrange(6)
    if kind == 0 and isinstance(node, dict):
        del node[path[-1]]
    elif kind == 1:
        deep = r.choice([50, 2000])
        node[path[-1]] = 'DEEP%d' % deep
    elif kind == 2 and isinstance(old, list):
        node[path[-1]] = old * r.choice([2, 1000]) if r.random() < 0.7 else old[:-1]
    elif kind == 3:
        node[path[-1]] = r.choice(TEXTS)
    else:
        node[path[-1]] = r.choice([r.choice(WHOLES), None, True, [], {}, 1e308, -1e-310, -0.5, [[]], [None]])
    return value


def json_text(value):
    text = json.dumps(value)
    return re.sub(r'"DEEP(\d+)"', lambda m: '[' * int(m[1]) + ']' * int(m[1]), text)


def json_grasps(r, cases, folder):
    value = json.loads(r.choice(sorted(cases.glob('grasps_*/good_*.json'))).read_text())
    for _ in range(r.randint(1, 3)):
        value = change_json(r, value)
    text = json_text(value).encode('utf-8', 'replace')
    return write(folder, 'mutant.json', cut(r, text) if r.random() < 0.15 else text)


def gltf(r, cases, folder):
    value = json.loads((cases / 'mesh/good.gltf').read_text())
    for _ in range(r.randint(1, 3)):
        value = change_json(r, value)
        if not isinstance(value, dict):
            break
    kind = r.randrange(4)
    if kind == 0 and isinstance(value, dict) and isinstance(value.get('buffers'), list) and value['buffers'] and isinstance(value['buffers'][0], dict):
        raw = bytes(r.randrange(256) for _ in range(r.choice([0, 7, 600])))
        value['buffers'][0]['uri'] = r.choice(['data:application/octet-stream;base64,' + base64.b64encode(raw).decode(), 'beside.bin', 'mutant.gltf',
                                               '../beside.bin', 'file:///etc/passwd', 'data:,', '%2e%2e/x', 'a' * 9000])
        write(folder, 'beside.bin', raw)
    if kind == 1 and isinstance(value, dict) and isinstance(value.get('nodes'), list):  # a tree that holds itself
        for node in value['nodes']:
            if isinstance(node, dict):
                node['children'] = [r.randrange(-1, 5)]
                node['matrix'] = [numbers(r) if r.random() < 0.2 else 1.0 for _ in range(r.choice([16, 15, 0]))]
    text = json_text(value).encode('utf-8', 'replace')
    if r.random() < 0.4:
        glb = (cases / 'mesh/good.glb').read_bytes()
        size = struct.unpack('<I', glb[12:16])[0]
        binary = glb[20 + size:]
        text = text.ljust((len(text) + 3) // 4 * 4)
        lengths = [len(text), 12 + 8 + len(text) + len(binary)]
        if r.random() < 0.5:
            lengths[r.randrange(2)] = r.choice([0, 1, 2**31, 2**32 - 1, 8])
        content = b'glTF' + struct.pack('<II', r.choice([2, 2, 2, 1, 0]), lengths[1]) + struct.pack('<I', lengths[0]) + b'JSON' + text + binary
        return write(folder, 'mutant.glb', cut(r, content) if r.random() < 0.2 else content)
    return write(folder, 'mutant.gltf', cut(r, text) if r.random() < 0.1 else text)


# --- meshes of lists
def mesh(r, cases, folder):
    kind = r.choice(['obj', 'ply', 'stl', 'bstl'])
    corners = [[(i & 1) * 20.0, (i >> 1 & 1) * 20.0, (i >> 2) * 20.0] for i in range(8)]
    faces = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]]
    for _ in range(r.randint(1, 3)):
        lie = r.randrange(5)
        if lie == 0:
            corners[r.randrange(8)][r.randrange(3)] = numbers(r)
        elif lie == 1:
            face = r.choice(faces)
            face[r.randrange(len(face))] = r.choice(WHOLES + [-2, -9])
        elif lie == 2:
            faces.append([r.randrange(8) for _ in range(r.choice([0, 1, 2, 300, 20000]))])
        elif lie == 3:
            corners = corners + [list(corners[0])] * r.choice([1, 30000])
        else:
            faces = faces * (r.choice([2, 3000]) if sum(map(len, faces)) < 100 else 1)  # 72,000 faces at most
    if kind == 'obj':
        lines = ['v %r %r %r' % tuple(c) for c in corners] + ['f ' + ' '.join(r.choice(['%d', '%d', '%d/1', '%d//2']) % (i + 1) for i in f) for f in faces]
        for _ in range(r.randrange(3)):
            lines.insert(r.randrange(len(lines)), r.choice(['mtllib /etc/passwd', 'mtllib beside.mtl', 'usemtl x', 'f', 'v', 'f 0 0 0', 'f -99 -1 2', 'v 1', 'vn nan nan nan',
                                                            'curv 0 1 1 2', 'call x.obj', '\\', 'l 1 2', 'v ' + words(r) + ' 1 2', 'g ' + 'n' * 9000]))
        content = '\n'.join(lines).encode('utf-8', 'replace')
        return write(folder, 'mutant.obj', cut(r, content) if r.random() < 0.2 else content)
    if kind == 'ply':
        count = [len(corners), len(faces)]
        if r.random() < 0.4:
            count[r.randrange(2)] = r.choice([0, 1, 10**9 - 1, 2**31, 2**32, 10**18, -1])
        form = r.choice(['ascii', 'ascii', 'binary_little_endian', 'binary_big_endian'])
        listed = r.choice(['list uchar int', 'list uchar int', 'list int int', 'list float int', 'list char double', 'int'])
        head = 'ply\nformat %s 1.0\n%selement vertex %d\nproperty float x\nproperty %s y\nproperty float z\nelement face %d\nproperty %s vertex_indices\nend_header\n' % (
            form, r.choice(['', 'comment ' + 'x' * 300 + '\n', 'element user %d\nproperty list uchar uchar u\n' % r.choice(WHOLES)]), count[0], r.choice(['float', 'float', 'double', 'uchar', 'x']), count[1], listed)
        if form == 'ascii':
            body = ('\n'.join(' '.join(repr(v) for v in c) for c in corners) + '\n' + '\n'.join('%d ' % len(f) + ' '.join(map(str, f)) for f in faces) + '\n').encode()
        else:
            order = '<' if 'little' in form else '>'
            body = b''.join(struct.pack(order + '3f', *[v if abs(v) < 3.4e38 or v != v or math.isinf(v) else 0 for v in c]) for c in corners)
            body += b''.join(bytes([len(f) & 255]) + b''.join(struct.pack(order + 'I', i & 2**32 - 1) for i in f) for f in faces)
        content = head.encode() + body
        return write(folder, 'mutant.ply', cut(r, content) if r.random() < 0.2 else content)
    triangles = [[corners[i % len(corners)] for i in (f + f + f)[:3]] for f in faces if f]
    if kind == 'stl':
        text = 'solid %s\n' % r.choice(['a', '', 'x' * 200])
        for t in triangles:
            text += 'facet normal 0 0 1\nouter loop\n' + ''.join('vertex %s %r %r\n' % (words(r) if r.random() < 0.01 else repr(p[0]), p[1], p[2]) for p in t[:r.choice([3, 3, 3, 2, 1])]) + 'endloop\nendfacet\n'
        content = (text + r.choice(['endsolid', 'endsolid\nsolid b\n', ''])).encode('utf-8', 'replace')
        return write(folder, 'mutant.stl', cut(r, content) if r.random() < 0.2 else content)
    count = len(triangles) if r.random() > 0.4 else r.choice([0, 1, 2**31 - 1, 2**32 - 1, 10**8])
    flat = lambda t: [0.0, 0.0, 1.0] + [v if abs(v) < 3.4e38 or v != v or math.isinf(v) else 0.0 for p in t for v in p]
    content = b'x' * 80 + struct.pack('<I', count) + b''.join(struct.pack('<12fH', *flat(t), r.choice([0, 65535])) for t in triangles)
    return write(folder, 'mutant.stl', cut(r, content) if r.random() < 0.2 else content)


# --- YAML: anchors, merges, depth
def yaml(r, cases, folder):
    return write(folder, 'mutant.yaml', yaml_lies(r, r.choice(sorted(cases.glob('grasps_isaac/good_*.yaml'))).read_text().split('\n')))


def yaml_lies(r, lines):
    kind = r.randrange(6)
    if kind == 0:
        bomb = ['a0: &a0 [x]'] + ['a%d: &a%d [%s]' % (i, i, ', '.join(['*a%d' % (i - 1)] * 10)) for i in range(1, r.choice([3, 12]))]
        lines = lines + bomb if r.random() < 0.5 else bomb + lines
        if r.random() < 0.5:
            lines = [re.sub(r'position: .*', 'position: *a2', line) for line in lines]
    elif kind == 1:
        lines.append(r.choice(['x: &x [*x]', '<<: *none', '? {a: b} : c', 'x: !!python/object/apply:os.system ["touch ran"]', 'x: !!binary aaaa', '%YAML 9.9', '--- \n...\n---']))
    elif kind == 2:
        depth = r.choice([20, 2000, 100000])
        lines.append('deep: ' + r.choice(['[' * depth + ']' * depth, '{a: ' * depth + '}' * depth, '- ' * depth]))
    else:
        for _ in range(r.randint(1, 4)):
            i = r.randrange(len(lines))
            key, colon, value = lines[i].partition(':')
            lines[i] = key + colon + ' ' + r.choice([words(r), '[' + words(r) + ']', '{}', '|', '&x', '*x', '"' + words(r)]) if colon else lines[i] * 2
    if kind == 5:
        lines = lines * r.choice([2, 50])
    content = '\n'.join(lines).encode('utf-8', 'replace')
    return cut(r, content) if r.random() < 0.15 else content


# --- tables of motion capture
def table(r, cases, folder):
    source = r.choice([p for kind in ('trc', 'qualisys_tsv', 'motive_csv', 'nexus_csv', 'n3d') for p in sorted(cases.glob('mocap_import/%s/good' % kind))])
    ending = {'trc': '.trc', 'qualisys_tsv': '.tsv', 'motive_csv': '.csv', 'nexus_csv': '.csv', 'n3d': '.n3d'}[source.parent.name]
    data = source.read_bytes()
    if ending == '.n3d':
        out = bytearray(data)
        for _ in range(r.randint(1, 4)):
            at = r.randrange(min(len(out), 256))
            out[at] = r.choice([0, 1, 127, 128, 255])
        return write(folder, 'mutant.n3d', bytes(out) if r.random() < 0.7 else cut(r, bytes(out)))
    lines = data.decode('utf-8', 'replace').split('\n')
    for _ in range(r.randint(1, 4)):
        i = r.randrange(len(lines))
        cells = re.split('([\t,])', lines[i])
        lie = r.randrange(6)
        if lie < 3:
            cells[r.randrange(len(cells))] = words(r)
            lines[i] = ''.join(cells)
        elif lie == 3:
            lines[i:i + 1] = [lines[i]] * r.choice([0, 2, 2000])
        elif lie == 4:
            lines[i] = lines[i] * r.choice([2, 500])
        else:
            lines[i] = ''.join(cells[:r.randrange(len(cells)) + 1])
        if not lines:
            break
    content = '\n'.join(lines).encode('utf-8', 'replace')
    return write(folder, 'mutant' + ending, cut(r, content) if r.random() < 0.1 else content)


# --- files of the program's own kinds, written by hand: YAML that unfolds, lies, or names other files
OWN = {'object': ('object.yaml', ['object', 'check', '--json', '.']), 'hand': ('hand.yaml', ['hand', 'show', '.']),
       'session': ('session.yaml', ['run', '--plan-only', '--out', 'OUT', 'session.yaml']), 'sweep': ('sweep.yaml', ['sweep', '--plan-only', '--out', 'OUT', 'sweep.yaml']),
       'pipeline': ('pipeline.yaml', ['pipeline', 'status', 'pipeline.yaml']), 'study': ('study.yaml', ['study', 'suggest', 'study.yaml'])}


def own(r, cases, folder):
    kind = r.choice(sorted(OWN))
    text = {'pipeline': 'stages:\n  a:\n    command: run\n    inputs: {session: session.yaml}\n    parameters: {trials: 1}\n',
            'session': 'hands: [tum]\nobjects: [golf_ball]\ntrials: 2\n', 'study': 'markers: {thumb: t, index: i}\n',
            'sweep': 'hands: [tum]\nobjects: [golf_ball]\ntrials: 1\nfactors: ["model.mass_scale=1,2"]\n',
            'object': 'name: block\nmesh: block.obj\nmesh_unit: mm\nmass_kg: 0.05\nfriction_static: 0.5\nfriction_dynamic: 0.4\n',
            'hand': 'name: pinch\n'}[kind]
    write(folder, 'session.yaml', b'hands: [tum]\nobjects: [golf_ball]\ntrials: 2\n')
    write(folder, 'trials.csv', b'participant,file\n01,none.c3d\n')
    write(folder, 'hand.urdf', xml.tostring(small_hand(cases)))
    write(folder, 'block.obj', (cases / 'mesh/good.obj').read_bytes())
    write(folder, OWN[kind][0], yaml_lies(r, text.split('\n')))
    return folder / OWN[kind][0]


# What files may leave out is said, so that nothing else is missing.
GRASPS = ['grasps', 'info', '--json', '--hand-frame', 'palm', '--object-frame', 'mesh', '--joint-names', 'a,b', '--scale', '1']
KINDS = {'c3d': (c3d, ['mocap', 'info', '--json']), 'table': (table, ['mocap', 'info', '--json']), 'npy': (npy, GRASPS),
         'json': (json_grasps, GRASPS), 'yaml': (yaml, GRASPS), 'gltf': (gltf, ['object', 'check', '--json']),
         'mesh': (mesh, ['object', 'check', '--json']), 'urdf': (urdf, ['hand', 'import', '--out', 'OUT']), 'mjcf': (mjcf, ['hand', 'import', '--out', 'OUT']),
         'collada': (collada, ['hand', 'import', '--out', 'OUT']), 'container': (container, None), 'own': (own, None),
         'demonstrations': (demonstrations, None)}


def command(kind, path, program):
    """What reads the mutant: the program's command, or Python with the program's package."""
    if kind == 'own':
        return [program] + next(words for name, words in OWN.values() if name == path.name)
    if kind == 'container':
        by_ending = {'npy': GRASPS, 'json': GRASPS, 'yaml': GRASPS, 'npz': GRASPS, 'pb': GRASPS, 'h5': GRASPS}
        return [program] + by_ending.get(path.suffix[1:], ['mocap', 'info', '--json']) + [path.name]
    if kind == 'demonstrations':
        package = Path(__file__).resolve().parents[3] / 'workbench/python'
        return [sys.executable, '-c', 'import sys; sys.path.insert(0, %r); from graspbench.demonstrations import read_demonstrations as read\ntry: read(sys.argv[1])\nexcept ValueError as e: sys.exit(3)' % str(package), path.name]
    return [program] + KINDS[kind][1] + [path.name]


def make(kind, seed, folder, cases):
    return KINDS[kind][0](random.Random('%s %d' % (kind, seed)), Path(cases), Path(folder))
