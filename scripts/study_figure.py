#!/usr/bin/env python3
"""Usage: study_figure.py FOLDER DOM SVG

Writes the first plot of a study's page, as a browser drew it (DOM, of chromium --dump-dom), to SVG, and prints what
study.json in FOLDER measured as the table of docs/accuracy.md.
"""
import json
import re
import sys

# The colours of the light theme of host/study/study_page.css.
COLORS = {'grid': '#e1e0d9', 'muted': '#6f6e69', 'c1': '#2a78d6'}


def figure(dom):
    svg = re.search(r'<figure id="overview">.*?(<svg viewBox="0 0 [0-9. ]+" role="img".*?</svg>)\s*<figcaption', dom, re.S).group(1)
    width, height = re.match(r'<svg viewBox="0 0 ([0-9.]+) ([0-9.]+)"', svg).groups()
    svg = re.sub(r'<title>.*?</title>', '', svg)
    for name, color in COLORS.items():
        svg = svg.replace(f'var(--{name})', color)
    assert 'var(' not in svg, 'a colour of the page is not known here'
    style = '<style>text{font:12px system-ui,sans-serif;fill:#52514e}</style><rect width="100%" height="100%" fill="#fcfcfb"/>'
    head = f'<svg xmlns="http://www.w3.org/2000/svg" width="{width}" height="{height}"'
    return re.sub(r'^<svg([^>]*)>', lambda m: head + m.group(1) + '>' + style, svg) + '\n'


def share(value):
    return f'{100 * value:.3g}%'


def table(data):
    study, targets = data['study'], data['targets']
    print(f"`scripts/study.sh` on {study['date']}: {study['scene']}, {study['width']} × {study['height']} pixels, on "
          f"{study['device']}; reference: {study['reference']['how']}, noise {share(study['reference']['error_90'])}.\n")
    heads = [f"error after {study['run_seconds']:.2g} s"] + [f'seconds to {share(target)}' for target in targets]
    print('| setting | ' + ' | '.join(heads) + ' |\n' + '|---' * (len(heads) + 1) + '|')
    for setting in data['analysis']['settings']:
        cells = [('~' if reach['extrapolated'] else '') + f"{reach['seconds']:.3g}" if reach['reached'] else '–'
                 for reach in setting['error_90']]
        end = setting['equal_time']
        name = 'the scene as it is' if setting['id'] == 'scene' else f"`{setting['id']}`"
        print(f"| {name} | {share(end['error_90'])} ± {share(end['error_90_error'])} | " + ' | '.join(cells) + ' |')


def main(folder, dom, svg):
    text = open(dom, encoding='utf-8').read()
    with open(svg, 'w', encoding='utf-8') as out:
        out.write(figure(text))
    page = open(folder + '/study.html', encoding='utf-8').read()
    table(json.loads(re.search(r'id="data">(.*?)</script>', page, re.S).group(1)))


if __name__ == '__main__':
    main(*sys.argv[1:])
