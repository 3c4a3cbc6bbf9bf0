"""Shares of samples by kernel and by inlined function: see profile.sh."""
import collections
import pathlib
import subprocess
import sys


def output(*command, text=None):
    return subprocess.run(command, input=text, capture_output=True, text=True, check=True).stdout


def samples(file):
    """{(library, symbol): {offset: count}}"""
    found = collections.defaultdict(collections.Counter)
    for line in output("perf", "script", "-i", file, "-F", "ip,sym,symoff,dso").splitlines():
        words = line.split()
        if len(words) >= 3 and "+0x" in words[1]:
            symbol, offset = words[1].rsplit("+", 1)
            found[words[-1].strip("()"), symbol][int(offset, 16)] += 1
        else:
            found["", ""][0] += 1
    return found


def inlined(library, symbol, offsets):
    """{offset: names of the functions around it, innermost first}"""
    table = output("nm", library).splitlines()
    start = next(int(line.split()[0], 16) for line in table if line.split()[-1] == symbol)
    addresses = "\n".join(hex(start + offset) for offset in offsets)
    chains, at = {}, None
    for line in output("addr2line", "-f", "-i", "-a", "-e", library, text=addresses).splitlines():
        if line.startswith("0x"):
            at = int(line, 16) - start
            chains[at] = []
        else:
            chains[at].append(line)
    return {offset: lines[0::2] for offset, lines in chains.items()}


def main():
    file, cache = sys.argv[1:]
    found = samples(file)
    total = sum(sum(offsets.values()) for offsets in found.values())
    by_weight = sorted(found.items(), key=lambda item: -sum(item[1].values()))
    kernels = [item for item in by_weight if item[0][0].startswith(str(pathlib.Path(cache).resolve()))]
    print("| function | share of all time |\n|---|---|")
    for (library, symbol), offsets in kernels[:8]:
        print(f"| {symbol} ({pathlib.Path(library).stem}) | {sum(offsets.values()) / total:.1%} |")
    for (library, symbol), offsets in kernels[:3]:
        count = sum(offsets.values())
        around = inlined(library, symbol, offsets)
        within, alone = collections.Counter(), collections.Counter()
        for offset, n in offsets.items():
            alone[around[offset][0]] += n
            for name in set(around[offset]):
                within[name] += n
        print(f"\n| {symbol} | with what it calls | alone |\n|---|---|---|")
        for name, n in within.most_common(24):
            if n >= 0.02 * count:
                print(f"| {name} | {n / count:.0%} | {alone[name] / count:.0%} |")


main()
