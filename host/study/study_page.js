// Fills the page from the numbers in it.
'use strict';

const data = JSON.parse(document.getElementById('data').textContent);
const {study, analysis, knobs, targets, insets} = data;
const by_id = new Map(analysis.settings.map((setting) => [setting.id, setting]));
const colors = [0, 1, 2, 3, 4, 5, 6].map((i) => `var(--c${i})`);
const place = (id) => document.getElementById(id);
const metric = () => document.querySelector('input[name=metric]:checked').value;
const metric_names = {rmse: 'relative RMSE', error_90: '90% of pixels within'};

// The standard error of an RMSE, from that of its square.
const error_of = (point, by) =>
  by === 'error_90' ? point.error_90_error : point.rmse > 0 ? point.mse_error / (2 * point.rmse) : 0;
const usable = (point, by) => point[by] > 0 && !(by === 'rmse' ? point.limited : point.limited_90);

const points_of = (setting, by) =>
  setting.curve.filter((point) => usable(point, by)).map((point) => ({
    x: point.seconds, y: point[by], error: error_of(point, by),
    title: `${setting.id}: ${percent(point[by])} after ${duration(point.seconds)}, ${digits(point.passes)} passes, ` +
           `mean of ${point.seeds} seed${point.seeds > 1 ? 's' : ''}`}));

const table = (heads, rows) => {
  const head = html_element('tr', {}, ...heads.map((text) => html_element('th', {scope: 'col'}, text)));
  const body = rows.map((row) => html_element('tr', {}, ...row.map((text) => html_element('td', {}, text))));
  return html_element('table', {}, html_element('thead', {}, head), html_element('tbody', {}, ...body));
};
const scrolled = (child) => html_element('div', {class: 'scroll'}, child);

const show_subject = () => {
  const name = study.scene.split('/').pop();
  document.title = `What accuracy costs: ${name}`;
  place('subject').textContent =
    `${name}, ${study.width} × ${study.height} pixels, on ${study.device}, ${study.date}. ` +
    `${study.runs.length} renders of ${analysis.settings.length} settings in ${duration(study.spent_seconds)}, ` +
    `causticl ${study.version}.`;
};

const show_advice = () => {
  const list = place('advice');
  for (const by of ['error_90', 'rmse']) {
    const advice = analysis.recommendations.filter((one) => one.metric === by);
    if (by === 'rmse') list.append(html_element('h3', {}, 'The same for the relative RMSE'));
    if (!advice.length) list.append(html_element('p', {class: 'note'}, 'No setting comes near any of the errors within this budget.'));
    for (const one of advice) {
      const by_time = one.goal.startsWith('time');
      const promise = by_time ? `${percent(one.error)} with ` : `${duration(one.seconds)}, ${one.passes} passes of `;
      const button = html_element('button', {type: 'button'}, 'Copy');
      const code = html_element('code', {}, one.command);
      button.addEventListener('click', () => {
        navigator.clipboard.writeText(one.command).then(() => { button.textContent = 'Copied'; });
      });
      list.append(html_element('div', {class: 'advice'},
        html_element('b', {}, (by_time ? 'In ' : 'To ') + one.goal.replace(/^\w+ /, '')), ' ', promise,
        one.setting === 'scene' ? 'the scene as it is' : one.setting, one.extrapolated ? ' (extrapolated)' : '',
        html_element('div', {class: 'command'}, code, button)));
    }
  }
};

const axes = (title, by, caption) => ({
  title, caption, x: 'time of the passes, seconds', y: by === 'rmse' ? 'relative RMSE' : 'error of 90% of pixels'});

const show_overview = () => {
  const by = metric();
  const series = analysis.settings.map((setting) => ({color: 'var(--muted)', width: 0.7, points: points_of(setting, by)}));
  const front = analysis.pareto[by].map(({setting, point}) => {
    const of = analysis.settings[setting];
    return {x: of.curve[point].seconds, y: of.curve[point][by], error: error_of(of.curve[point], by), id: of.id,
            title: `${of.id}: ${percent(of.curve[point][by])} after ${duration(of.curve[point].seconds)}`};
  });
  series.push({name: 'the best there is at each time (Pareto front)', color: 'var(--c1)', shape: 0, width: 2.4, points: front});
  const names = [...new Set(front.map((point) => point.id))].map((id) => (id === 'scene' ? 'the scene as it is' : id));
  draw_plot(place('overview'), series, [], axes('error against time of all settings', by,
    'Each thin line is one setting; nothing that was measured is both sooner and more accurate than the thick line. ' +
    `On it, from left to right: ${names.join(', then ')}.`));
};

// Lines of the slopes of theory, through the first point of a curve of each kind.
const ideal_slopes = (settings, by) => {
  const slopes = [];
  for (const path_traced of [true, false]) {
    const first = settings.filter((one) => one.path_traced === path_traced).map((one) => points_of(one, by)[0]).find(Boolean);
    if (!first) continue;
    const mse = path_traced ? '−1' : '−2/3';
    slopes.push({x: first.x, y: first.y, slope: path_traced ? -1 / 2 : -1 / 3,
                 name: `theory: MSE falls with slope ${mse}, its root with ${path_traced ? '−1/2' : '−1/3'}` +
                       (path_traced ? ' (path tracing, independent samples)' : ' (photon mapping)')});
  }
  return slopes;
};

const settings_of = (knob) => [by_id.get(knob.base), ...analysis.settings.filter((one) => one.knob === knob.name && one.id !== knob.base)].filter(Boolean);
const label_of = (knob, setting) => (setting.id === knob.base ? `${knob.own} (the scene's own)` : setting.value);

const make_knobs = () => {
  for (const knob of knobs) {
    const settings = settings_of(knob);
    if (settings.length < 2) continue;
    const rows = settings.map((setting) => {
      const end = setting.equal_time;
      return [label_of(knob, setting), digits(end.seconds) + ' s', `${percent(end.rmse)} ± ${percent(error_of(end, 'rmse'))}`,
              `${percent(end.error_90)} ± ${percent(end.error_90_error)}`,
              setting.slope ? `${setting.slope.toFixed(2)} ± ${setting.slope_error.toFixed(2)}` : '–',
              end.mse > 0 ? digits(1 / (end.mse * end.seconds)) : '–'];
    });
    place('knobs').append(html_element('h3', {}, knob.title + (knob.unit ? ` (${knob.unit})` : '')),
      html_element('figure', {id: `plot_${knob.name}`, class: 'knob'}),
      scrolled(table(['value', 'time', 'relative RMSE', '90% of pixels within', 'slope of MSE', 'efficiency 1/(MSE·s)'], rows)));
  }
};

const show_knobs = () => {
  const by = metric();
  for (const knob of knobs) {
    const figure = place(`plot_${knob.name}`);
    if (!figure) continue;
    const settings = settings_of(knob);
    const series = settings.map((setting, i) => ({
      name: label_of(knob, setting), color: colors[i % colors.length], shape: i, points: points_of(setting, by)}));
    draw_plot(figure, series, ideal_slopes(settings, by), axes(`error against time: ${knob.title}`, by, knob.meaning));
  }
};

const show_times = () => {
  const cell = (reach) => (reach.reached ? (reach.extrapolated ? '~' : '') + digits(reach.seconds) : '–');
  const rows = analysis.settings.map((setting) => [
    setting.id === 'scene' ? 'the scene as it is' : setting.id,
    ...targets.map((_, i) => `${cell(setting.rmse[i])} / ${cell(setting.error_90[i])}`)]);
  place('times').append(table(['setting', ...targets.map((target) => `to ${percent(target)}`)], rows));
};

const show_insets = () => {
  const grid = place('insets');
  const image = (source, text) => html_element('img', {src: source, alt: text});
  const whole = html_element('div', {class: 'whole'}, image(insets.whole, 'the reference'));
  for (const {x, y, size} of insets.places)
    whole.append(html_element('i', {style: `left:${(100 * x) / study.width}%;top:${(100 * y) / study.height}%;` +
      `width:${(100 * size) / study.width}%;height:${(100 * size) / study.height}%`}));
  grid.append(html_element('figure', {}, whole, html_element('figcaption', {}, 'the reference, and where the cut-outs are')));
  const add = (cuts, name) => grid.append(html_element('figure', {},
    html_element('div', {class: 'cuts'}, ...cuts.map((source) => image(source, name))), html_element('figcaption', {}, name)));
  add(insets.reference, 'reference');
  for (const [id, cuts] of Object.entries(insets.settings)) {
    const end = by_id.get(id).equal_time;
    add(cuts, `${id === 'scene' ? 'the scene as it is' : id}: ${percent(end[metric()])} after ${digits(end.seconds)} s`);
  }
  place('inset_text').textContent =
    `What each setting shows after about ${digits(study.run_seconds)} seconds of passes, pixel by pixel, where the settings ` +
    'differ the most to the eye.';
};

const show_kernels = () => {
  const figure = place('kernels');
  const names = [...new Set(analysis.settings.flatMap((one) => one.kernels.slice(0, 4).map((k) => k.kernel)))].slice(0, 6);
  const rows = analysis.settings.map((one) => {
    const of = new Map(one.kernels.map((k) => [k.kernel, k.milliseconds]));
    const total = one.kernels.reduce((sum, k) => sum + k.milliseconds, 0);
    const parts = names.map((name) => of.get(name) || 0);
    return {one, total, parts: [...parts, total - parts.reduce((a, b) => a + b, 0)]};
  });
  figure.append(scrolled(table(['setting', ...names, 'others', 'all kernels', 'start-up, s'],
    rows.map(({one, total, parts}) => [one.id === 'scene' ? 'the scene as it is' : one.id, ...parts.map(digits), digits(total), digits(one.setup_seconds)]))),
    html_element('figcaption', {}, 'Milliseconds of each kernel in one pass (for path tracing: one sample a pixel), and what comes before ' +
      'the first pass: loading kernels and building the tree.'));
};

const show_method = () => {
  const reference = study.reference;
  const noise = reference.relative_mse > 0
    ? ` Two independent halves of it differ by what makes its own noise a relative RMSE of ${percent(Math.sqrt(reference.relative_mse))} ` +
      `(90% of pixels: ${percent(reference.error_90)}); this is taken off every error, as a square, and measurements that are mostly ` +
      'this noise are not shown.' : '';
  const paragraphs = [
    `Errors are measured against a reference: ${reference.how}.${noise}`,
    'Relative RMSE: the root of the mean over pixels and channels of the squared difference, over the mean of the reference. ' +
    'A few very wrong pixels, as at the edge of a lamp, decide it.',
    '90% of pixels within: the difference in luminance over the luminance of the reference (at least a tenth of its mean), which ' +
    '90% of the pixels stay under.',
    'Slope: how the logarithm of the MSE, the square of the relative RMSE, falls with the logarithm of the passes: −1 for noise that ' +
    'independent passes average out, steeper where samples are even, −2/3 for photon mapping whose radius shrinks at the best rate (alpha 2/3).',
    `Each setting was rendered for ${digits(study.run_seconds)} s of passes with up to ${study.seeds} seeds or more, as the budget allowed; ` +
    'curves are the means over seeds. What was left of the budget let the most promising settings go on for longer, with one seed. ' +
    'Kernels were compiled before the clock started.',
    'At another size the same number of passes gives about the same error, and takes longer in proportion to the pixels.'];
  place('method').append(...paragraphs.map((text) => html_element('p', {}, text)));
  if (study.left_out.length) {
    place('method').append(html_element('h3', {}, 'Left out'),
      html_element('ul', {}, ...study.left_out.map((text) => html_element('li', {}, text))));
  }
};

const show_plots = () => { show_overview(); show_knobs(); };

// "?plots=error_90" opens the page with that error in its plots.
const asked = new URLSearchParams(location.search).get('plots');
for (const input of document.querySelectorAll('input[name=metric]')) if (input.value === asked) input.checked = true;
show_subject();
show_advice();
make_knobs();
show_plots();
show_insets();
show_times();
show_kernels();
show_method();
for (const input of document.querySelectorAll('input[name=metric]')) input.addEventListener('change', show_plots);
let drawn_width = document.body.clientWidth;
window.addEventListener('resize', () => {
  if (document.body.clientWidth === drawn_width) return;
  drawn_width = document.body.clientWidth;
  show_plots();
});
