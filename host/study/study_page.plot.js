// Plots on logarithmic axes, as SVG.
'use strict';

const svg_element = (name, attributes, text) => {
  const element = document.createElementNS('http://www.w3.org/2000/svg', name);
  for (const [key, value] of Object.entries(attributes)) element.setAttribute(key, value);
  if (text !== undefined) element.textContent = text;
  return element;
};

const html_element = (name, attributes = {}, ...children) => {
  const element = document.createElement(name);
  for (const [key, value] of Object.entries(attributes)) element.setAttribute(key, value);
  element.append(...children);
  return element;
};

// Three significant digits: "0.0123", "12.3", "12300".
const digits = (value) => {
  if (!isFinite(value)) return '∞';
  const text = Number(value.toPrecision(3));
  return Math.abs(text) >= 1e6 || (text !== 0 && Math.abs(text) < 1e-4) ? text.toExponential() : String(text);
};
const percent = (fraction) => (fraction === null ? '∞' : digits(100 * fraction) + '%');
const duration = (seconds) =>
  seconds < 120 ? digits(seconds) + ' s' : seconds < 7200 ? digits(seconds / 60) + ' min' : digits(seconds / 3600) + ' h';

// Shapes, so that curves differ without colour too.
const marker = (index, x, y, color) => {
  const r = 3.6;
  const paths = [
    `M${x - r},${y}a${r},${r} 0 1,0 ${2 * r},0a${r},${r} 0 1,0 ${-2 * r},0`,
    `M${x - r},${y - r}h${2 * r}v${2 * r}h${-2 * r}z`,
    `M${x},${y - r - 1}l${r + 1},${2 * r}h${-2 * r - 2}z`,
    `M${x},${y - r - 1}l${r + 1},${r + 1}l${-r - 1},${r + 1}l${-r - 1},${-r - 1}z`,
    `M${x},${y + r + 1}l${r + 1},${-2 * r}h${-2 * r - 2}z`];
  return svg_element('path', {d: paths[index % paths.length], fill: color, class: 'point'});
};

// Ticks at 1, 2, 5 times powers of ten; at powers of ten alone where the axis is long.
const log_ticks = (low, high, room) => {
  const decades = Math.log10(high / low);
  const factors = decades < room / 2.5 ? [1, 2, 5] : [1];
  const ticks = [];
  for (let e = Math.floor(Math.log10(low)); e <= Math.ceil(Math.log10(high)); ++e)
    for (const factor of factors) {
      const tick = factor * 10 ** e;
      if (tick >= low * 0.999 && tick <= high * 1.001) ticks.push(tick);
    }
  return ticks;
};

// Draws `series`, a list of {name, color, shape, width, points: [{x, y, error, title}], marks}, into `figure`.
// `slopes` are lines {x, y, slope, name} through a point. Returns nothing; what `figure` had is replaced.
const draw_plot = (figure, series, slopes, axes) => {
  const all = series.flatMap((one) => one.points);
  figure.replaceChildren();
  if (all.length < 2) {
    figure.append(html_element('p', {class: 'note'}, 'Not enough was measured for a plot.'));
    return;
  }
  const width = Math.max(300, Math.min(figure.clientWidth || 860, 900)), height = Math.min(430, 180 + width * 0.3);
  const left = 58, right = 14, top = 14, bottom = 46;
  const grown = (values, factor) => [Math.min(...values) / factor, Math.max(...values) * factor];
  const [x_low, x_high] = grown(all.map((p) => p.x), 1.15);
  const [y_low, y_high] = grown(all.map((p) => p.y), 1.2);
  const x_of = (x) => left + (Math.log(x / x_low) / Math.log(x_high / x_low)) * (width - left - right);
  const y_of = (y) => top + (Math.log(y_high / y) / Math.log(y_high / y_low)) * (height - top - bottom);
  const root = svg_element('svg', {viewBox: `0 0 ${width} ${height}`, role: 'img', 'aria-label': axes.title});

  for (const tick of log_ticks(x_low, x_high, width / 60)) {
    root.append(svg_element('line', {x1: x_of(tick), x2: x_of(tick), y1: top, y2: height - bottom, stroke: 'var(--grid)'}));
    root.append(svg_element('text', {x: x_of(tick), y: height - bottom + 17, 'text-anchor': 'middle'}, digits(tick)));
  }
  for (const tick of log_ticks(y_low, y_high, height / 28)) {
    root.append(svg_element('line', {x1: left, x2: width - right, y1: y_of(tick), y2: y_of(tick), stroke: 'var(--grid)'}));
    root.append(svg_element('text', {x: left - 7, y: y_of(tick) + 4, 'text-anchor': 'end'}, percent(tick)));
  }
  root.append(svg_element('text', {x: (left + width - right) / 2, y: height - 8, 'text-anchor': 'middle'}, axes.x));
  root.append(svg_element('text', {x: -(top + height - bottom) / 2, y: 12, transform: 'rotate(-90)', 'text-anchor': 'middle'}, axes.y));

  for (const line of slopes) {
    // Clipped to the plot, from the point on to the right.
    const down = line.slope < 0 ? (y_low / line.y) ** (1 / line.slope) : Infinity;
    const end = Math.min(x_high, line.x * down);
    root.append(svg_element('line', {
      x1: x_of(line.x), y1: y_of(line.y), x2: x_of(end), y2: y_of(line.y * (end / line.x) ** line.slope),
      stroke: 'var(--muted)', 'stroke-dasharray': '5 4', 'stroke-width': 1.4, class: 'ideal'}));
  }
  for (const one of series) {
    const path = one.points.map((p, i) => `${i ? 'L' : 'M'}${x_of(p.x).toFixed(1)},${y_of(p.y).toFixed(1)}`).join('');
    root.append(svg_element('path', {d: path, fill: 'none', stroke: one.color, 'stroke-width': one.width || 1.8, class: 'curve'}));
    if (one.shape === undefined) continue;
    for (const p of one.points) {
      if (p.error > 0) {
        const low = Math.max(p.y - p.error, y_low), high = Math.min(p.y + p.error, y_high);
        root.append(svg_element('line', {x1: x_of(p.x), x2: x_of(p.x), y1: y_of(low), y2: y_of(high), stroke: one.color, class: 'bar'}));
      }
      const point = marker(one.shape, x_of(p.x), y_of(p.y), one.color);
      point.append(svg_element('title', {}, p.title));
      root.append(point);
    }
  }
  const legend = html_element('div', {class: 'legend'});
  const swatch = (draw, name) => {
    const icon = svg_element('svg', {viewBox: '0 0 26 12', 'aria-hidden': 'true'});
    icon.append(...draw);
    legend.append(html_element('span', {}, icon, name));
  };
  for (const one of series)
    if (one.name)
      swatch([svg_element('line', {x1: 0, x2: 26, y1: 6, y2: 6, stroke: one.color, 'stroke-width': 1.8}),
              ...(one.shape === undefined ? [] : [marker(one.shape, 13, 6, one.color)])], one.name);
  for (const line of slopes)
    swatch([svg_element('line', {x1: 0, x2: 26, y1: 6, y2: 6, stroke: 'var(--muted)', 'stroke-dasharray': '5 4'})], line.name);
  figure.append(legend, root, html_element('figcaption', {}, axes.caption));
};
