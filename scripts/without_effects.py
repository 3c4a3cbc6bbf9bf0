#!/usr/bin/env python3
"""Usage: without_effects.py FOLDER EFFECT...

Deletes effects (as in EFFECT_GLASS) from the kernel sources in FOLDER, a copy of cl/: every statement and every
condition that asks for none but them, and then every function that nothing calls any more. What is left knows nothing
of these effects. Prints how many lines went.
"""
import pathlib
import re
import sys


def closing(text, opening):
    """Where the bracket that opens at `opening` closes."""
    pairs, depth = {'(': ')', '{': '}'}, 0
    for i in range(opening, len(text)):
        depth += (text[i] == text[opening]) - (text[i] == pairs[text[opening]])
        if depth == 0:
            return i
    raise ValueError('a bracket does not close')


def statement_end(text, start):
    """Behind the statement that begins at or after `start`."""
    start += len(text[start:]) - len(text[start:].lstrip())
    if text[start] == '{':
        return closing(text, start) + 1
    header = re.match(r'(if|for|while)\s*(?=\()', text[start:])
    if not header:
        return text.index(';', start) + 1
    end = statement_end(text, closing(text, start + header.end()) + 1)
    rest = re.match(r'\s*else\b', text[end:])
    return statement_end(text, end + rest.end()) if header.group(1) == 'if' and rest else end


def without_comments(text):
    return re.sub(r'//[^\n]*|/\*.*?\*/', '', text, flags=re.S)


GONE = 'HAS_NONE'


def delete_statement(text, at):
    """Deletes the `if (HAS_NONE && ...)` that begins at `at`, and keeps what its else holds."""
    end_of_condition = closing(text, text.index('(', at))
    end = end_of_condition + 1
    body_end = statement_end(text, end)
    rest = re.match(r'\s*else\b', text[body_end:])
    if rest:
        return text[:at] + text[body_end + rest.end():].lstrip(' ')
    before = re.search(r'\belse\s*$', text[:at])
    return text[:before.start() if before else at] + text[body_end:]


def delete_conditions(text, effects):
    def names_left(match):
        names = [name for name in re.split(r'\s*\|\s*', match.group(1)) if name not in effects]
        return f'HAS({" | ".join(names)})' if names else GONE

    text = re.sub(r'HAS\(((?:EFFECT|OUTPUT)_[^)]*)\)', names_left, text)
    while True:
        if found := re.search(rf'\bif \({GONE}( &&|\))', text):
            text = delete_statement(text, found.start())
        elif found := re.search(rf'\bif \(!{GONE}\)', text):
            text = text[:found.start()] + text[found.end():]
        elif found := re.search(rf'{GONE} \?[^:;]*:', text):
            text = text[:found.start()] + text[found.end():]
        elif found := re.search(rf'{GONE} && ', text):  # the rest of the conjunction goes with it
            end, depth = found.end(), 0
            while depth > 0 or not (text[end] in ',;)?' or text.startswith('||', end)):
                depth += (text[end] == '(') - (text[end] == ')')
                end += 1
            text = text[:found.start()] + 'false' + text[end:]
        elif found := re.search(GONE, text):
            text = text[:found.start()] + 'false' + text[found.end():]
        else:
            return text


FUNCTION = re.compile(r'^(?:INLINE|NOINLINE|SHARED)?\s*(?:[a-z_A-Z]\w*[ *]+)+(\w+)\([^;{]*\)\s*\{', re.M)


def delete_functions(files):
    """Functions that no kernel needs; True where there was one."""
    everything = '\n'.join(without_comments(text) for text in files.values())
    for name, text in files.items():
        for found in FUNCTION.finditer(text):
            function = found.group(1)
            if re.search(r'\bkernel\b', found.group(0)) or len(re.findall(rf'\b{function}\b', everything)) > 1:
                continue
            files[name] = text[:found.start()] + text[closing(text, found.end() - 1) + 1:]
            return True
    return False


def main():
    folder, effects = pathlib.Path(sys.argv[1]), set(sys.argv[2:])
    files = {path: path.read_text() for path in sorted(folder.rglob('*.cl'))}
    lines = sum(text.count('\n') for text in files.values())
    for path in files:
        files[path] = delete_conditions(without_comments(files[path]), effects)
    while delete_functions(files):
        pass
    for path, text in files.items():
        path.write_text(text)
    code = [line for text in files.values() for line in text.split('\n') if line.strip()]
    print(f'{lines} lines, {len(code)} of code without', *sorted(effects))


main()
