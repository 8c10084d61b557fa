"""Damaged HDF5, MCAP, NPZ and protobuf files; demonstrations in HDF5 in the layout of robomimic."""
import io, struct, zipfile
from lies import WHOLES, cut, write


def container(r, _cases, folder):
    kind = r.choice(['h5', 'mcap', 'npz', 'pb'])
    if kind == 'h5':
        content = b'\x89HDF\r\n\x1a\n' + struct.pack('<8B', 0, 0, 0, 0, 0, 8, 8, 0) + struct.pack('<HHI', 4, 16, 0)
        content += b''.join(struct.pack('<Q', r.choice([0, 96, 2**63, 2**64 - 1, 800])) for _ in range(9)) + b'TREE' + bytes(r.randrange(256) for _ in range(600))
    elif kind == 'mcap':
        magic = b'\x89MCAP0\r\n'
        content = magic
        for _ in range(r.randrange(1, 9)):
            body = bytes(r.randrange(256) for _ in range(r.choice([0, 4, 60])))
            length = len(body) if r.random() < 0.7 else r.choice([0, 2**31, 2**63, 2**64 - 1])
            content += bytes([r.choice([1, 2, 3, 4, 5, 6, 15, 200])]) + struct.pack('<Q', length) + body
        content += magic if r.random() < 0.7 else b''
    elif kind == 'npz':
        body = b'\x93NUMPY\x01\x00' + struct.pack('<H', 118) + repr({'descr': '<f8', 'fortran_order': False, 'shape': (r.choice([3, 10**12]), 7)}).encode().ljust(117) + b'\n' + bytes(168)
        packed = io.BytesIO()
        with zipfile.ZipFile(packed, 'w', zipfile.ZIP_DEFLATED) as archive:
            for name in r.choice([['a.npy'], ['../a.npy'], ['a.npy', 'a.npy'], ['/etc/x.npy'], ['n' * 9000]]):
                archive.writestr(name, body + bytes(r.choice([0, 10**6, 10**8])))
        content = packed.getvalue()
    else:
        content = b''
        for _ in range(r.randrange(1, 40)):
            value = r.choice(WHOLES) & 2**64 - 1
            varint = bytearray()
            while value > 127:
                varint.append(value & 127 | 128)
                value >>= 7
            content += bytes([r.randrange(256)]) + bytes(varint) + bytes([value]) + bytes(r.randrange(256) for _ in range(r.randrange(9)))
    ending = r.choice([kind, 'c3d', 'npy', 'csv', 'trc', 'json', 'yaml'])
    return write(folder, 'mutant.' + ending, cut(r, content) if r.random() < 0.3 else content)


def lie_in_hdf5(r, file, name):
    import h5py
    import numpy
    lie = r.randrange(10)
    if name.endswith('attrs'):
        file[name[:-6]].attrs[r.choice(['num_samples', 'outcome', 'x' * 300])] = r.choice([float('nan'), 'x' * 9000, numpy.zeros(1000), numpy.bytes_(b'a\xff'), numpy.void(b'aa')])
        return
    if name in file:
        del file[name]
    if lie == 0:
        pass
    elif lie == 1:
        file.create_dataset(name, shape=(r.choice([10**8, 10**12, 2**62]),), chunks=(1000,), dtype='f8', compression='gzip')
    elif lie == 2:
        file[name] = h5py.ExternalLink(r.choice(['mutant.h5', '/etc/passwd', '/dev/zero', 'none.h5']), '/data')
    elif lie == 3:
        file[name] = h5py.SoftLink(r.choice(['/', '/data', '/none', name]))
    elif lie == 4:
        file.create_dataset(name, shape=(40,), dtype='u1', external=[(r.choice(['/etc/passwd', 'none.raw']), 0, 40)])
    elif lie == 5:
        file[name] = r.choice([numpy.array([b'a', b'bb']), numpy.array(7.0), numpy.zeros((0, 3)), numpy.array([numpy.nan] * 5), numpy.zeros(5, dtype=[('a', 'f8'), ('b', 'i4')])])
    elif lie == 6:
        file.create_dataset(name, data=['text'] * 5, dtype=h5py.string_dtype())
    elif lie == 7:
        file[name] = file['data'] if r.random() < 0.5 else h5py.Empty('f8')
    elif lie == 8:
        file.create_group(name + '/deeper')
    else:
        file.create_dataset(name, data=numpy.zeros(10**7), compression='gzip', compression_opts=9) if r.random() < 0.2 else file.create_group('data/' + r.choice(['demo_x', 'demo_-1', 'demo_99999999999999999999', '\u202e']))


def demonstrations(r, _cases, folder):
    import h5py
    import numpy
    path = folder / 'mutant.h5'
    with h5py.File(path, 'w') as file:
        for i in range(2):
            demo = file.create_group('data/demo_%d' % i)
            demo.attrs['num_samples'] = 5
            for name, shape in (('actions', (5, 3)), ('rewards', (5,)), ('dones', (5,)), ('obs/q', (5, 3)), ('next_obs/q', (5, 3))):
                demo[name] = numpy.zeros(shape)
        for _ in range(r.randint(1, 3)):
            try:
                lie_in_hdf5(r, file, 'data/demo_%d/%s' % (r.randrange(2), r.choice(['actions', 'rewards', 'dones', 'obs/q', 'obs', 'attrs'])))
            except (OSError, ValueError, RuntimeError, KeyError, TypeError):
                pass  # two lies that exclude each other
    if r.random() < 0.2:
        path.write_bytes(cut(r, path.read_bytes()))
    return path
