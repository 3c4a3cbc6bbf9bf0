#!/usr/bin/env python3
"""Usage: study_page_check.py FOLDER DOM

Compares the page of a study as a browser drew it (DOM, of chromium --dump-dom) with study.csv in FOLDER: every plot
has its curves and points, every inset its picture, and every error in the tables is the mean that the CSV has.
"""
import csv
import json
import math
import re
import sys
from html.parser import HTMLParser


class Page(HTMLParser):
    """Text of table rows by figure or heading, points and curves of each figure, sources of images."""

    def __init__(self):
        super().__init__()
        self.figure, self.heading, self.in_heading, self.cell, self.script = None, '', False, None, None
        self.points, self.curves, self.images, self.rows, self.data = {}, {}, [], [], ''

    def handle_starttag(self, tag, attributes):
        of = dict(attributes)
        if tag == 'figure':
            self.figure = of.get('id')
        elif tag == 'h3':
            self.in_heading, self.heading = True, ''
        elif tag == 'path' and 'point' in of.get('class', ''):
            self.points[self.figure] = self.points.get(self.figure, 0) + 1
        elif tag == 'path' and of.get('class') == 'curve':
            self.curves[self.figure] = self.curves.get(self.figure, 0) + (len(of['d']) > 0)
            assert 'NaN' not in of['d'], 'a curve with NaN in ' + str(self.figure)
        elif tag == 'img':
            self.images.append(of['src'])
        elif tag == 'tr':
            self.rows.append([])
        elif tag == 'td':
            self.cell = ''
        elif tag == 'script' and of.get('id') == 'data':
            self.script = True

    def handle_endtag(self, tag):
        if tag == 'h3':
            self.in_heading = False
        elif tag == 'td':
            self.rows[-1].append(self.cell)
            self.cell = None
        elif tag == 'script':
            self.script = None

    def handle_data(self, text):
        if self.in_heading:
            self.heading += text
        if self.cell is not None:
            self.cell += text
        if self.script:
            self.data += text


def percent(text):
    return float(text.strip().rstrip('%')) / 100


def main(folder, dom):
    page = Page()
    page.feed(open(dom, encoding='utf-8').read())
    data = json.loads(page.data)
    rows = list(csv.DictReader(open(folder + '/study.csv', encoding='utf-8', newline='')))

    samples = [(run, sample) for run in data['study']['runs'] for sample in run['samples']]
    assert len(rows) == len(samples) > 0, 'the page has other measurements than study.csv'
    for row, (run, sample) in zip(rows, samples):
        assert (row['knob'], row['value'], int(row['seed'])) == (run['knob'], run['value'], run['seed'])
        for key in ('passes', 'photons', 'seconds', 'relative_mse', 'error_90', 'flip', 'mean'):
            assert float(row[key]) == (math.inf if sample[key] is None else sample[key]), (row, key)

    # A table shows the mean over seeds of the last measurement of short runs, the reference's noise taken off.
    reference = data['study']['reference']
    checked = 0
    for knob in data['knobs']:
        settings = [s for s in data['analysis']['settings'] if s['knob'] == knob['name'] or s['id'] == knob['base']]
        if len(settings) < 2:
            continue
        figure = 'plot_' + knob['name']
        assert page.curves.get(figure, 0) == len(settings), figure + ' lacks curves'
        drawn = sum(p['rmse'] > 0 and not p['limited'] for s in settings for p in s['curve'])
        legend = len(settings)
        assert page.points.get(figure, 0) == drawn + legend, (figure, page.points.get(figure, 0), drawn + legend)
        for setting in settings:
            last = {}
            for row in rows:
                if (row['knob'], row['value'], row['long']) == (setting['knob'], setting['value'], '0'):
                    last[row['seed']] = row
            mse = sum(float(r['relative_mse']) for r in last.values()) / len(last) - reference['relative_mse']
            e90 = sum(float(r['error_90']) for r in last.values()) / len(last)
            e90 = math.sqrt(max(0, e90 ** 2 - reference['error_90'] ** 2))
            label = knob['own'] + " (the scene's own)" if setting['id'] == knob['base'] else setting['value']
            shown = [row for row in page.rows if len(row) == 6 and row[0] == label
                     and abs(percent(row[2].split('±')[0]) - math.sqrt(max(0, mse))) <= 0.006 * math.sqrt(max(0, mse))
                     and abs(percent(row[3].split('±')[0]) - e90) <= 0.006 * e90]
            assert shown, 'no row of the page shows what study.csv has of ' + setting['id']
            checked += 1
    assert checked > 2, 'no tables of knobs'
    assert page.points.get('overview', 0) > 2 and page.curves['overview'] == len(data['analysis']['settings']) + 1
    places = len(data['insets']['places'])
    insets = places * (len(data['insets']['settings']) + 1) + 1
    assert places > 0 and len(page.images) == insets, (len(page.images), insets)
    assert all(re.match(r'data:image/png;base64,iVBOR', source) for source in page.images)
    print(f'{len(rows)} measurements, {checked} rows of tables, {sum(page.curves.values())} curves and '
          f'{len(page.images)} insets are on the page as in study.csv')


if __name__ == '__main__':
    main(*sys.argv[1:])
