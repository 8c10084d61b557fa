"""run_mutants.py PROGRAM CASES [KIND..] [--count N] [--first N]: graspbench reads N mutants of each kind (mutants.py).

Each must end within 30 s of processor time and 1 GB with 0, 1, 2 or 3, write nothing but its output, and run nothing. What
does not is printed and kept in the current folder; exit code 1. Readers that crash within the fence are counted apart.
The kind demonstrations needs a Python with h5py."""
import argparse, collections, os, shutil, signal, sys, tempfile
from pathlib import Path
sys.path.insert(0, str(Path(__file__).parent))
import mutants


def run(command, folder, log):
    """Exit code (negative: signal), seconds of processor time, megabytes; of it and its readers."""
    process = os.fork()
    if process == 0:
        os.chdir(folder)
        out = os.open(log, os.O_WRONLY | os.O_CREAT | os.O_TRUNC, 0o600)
        os.dup2(out, 1)
        os.dup2(out, 2)
        os.environ['HOME'] = os.environ['XDG_CACHE_HOME'] = str(log.parent)
        signal.alarm(600)  # of a clock, on a busy machine
        os.execv(command[0], command)
    _, status, used = os.wait4(process, 0)
    return os.waitstatus_to_exitcode(status), used.ru_utime + used.ru_stime, used.ru_maxrss / 1024


def listing(folder):
    return sorted(str(p.relative_to(folder)) for p in folder.rglob('*'))


parser = argparse.ArgumentParser()
parser.add_argument('program')
parser.add_argument('cases')
parser.add_argument('kinds', nargs='*', default=[])
parser.add_argument('--count', type=int, default=600)
parser.add_argument('--first', type=int, default=0)
options = parser.parse_args()
program = os.path.abspath(options.program)
num_bad = 0
for kind in options.kinds or mutants.KINDS:
    codes, longest, largest, num_contained = collections.Counter(), (0, 0), (0, 0), 0
    for seed in range(options.first, options.first + options.count):
        with tempfile.TemporaryDirectory() as scratch:
            folder = Path(scratch) / 'work'
            folder.mkdir()
            path = mutants.make(kind, seed, folder, options.cases)
            before = listing(folder)
            code, seconds, megabytes = run(mutants.command(kind, path, program), folder, Path(scratch) / 'log')
            new = [name for name in listing(folder) if name not in before and not name.startswith('OUT')]
            codes[code] += 1
            longest, largest = max(longest, (seconds, seed)), max(largest, (megabytes, seed))
            text = (Path(scratch) / 'log').read_text(errors='replace')
            is_contained = 'its reader ended by signal' in text
            num_contained += is_contained
            if is_contained or code not in (0, 1, 2, 3) or seconds > 30 or megabytes > 1024 or new:
                num_bad += not is_contained
                kept = '%s_%d%s' % (kind, seed, path.suffix)
                shutil.copy(path, kept)
                print('%s: exit code %d, %.1f s, %.0f MB, new files %s: %s' % (kept, code, seconds, megabytes, new, text[-300:]), flush=True)
    fenced = ', '.join('%d: %d' % item for item in sorted(codes.items()))
    print('%s: %d mutants; exit codes %s; %d crashed within the fence; longest %.1f s (%d), largest %.0f MB (%d)' % (
        kind, options.count, fenced, num_contained, *longest, *largest), flush=True)
sys.exit(1 if num_bad else 0)
