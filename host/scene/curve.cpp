#include "scene/curve.hpp"

#include <algorithm>
#include <numbers>

namespace causticl {
namespace {

// Coefficients in the Bernstein basis over [0, 1].
using Polynomial = std::vector<double>;

double evaluate(Polynomial b, double t) {
  for (std::size_t n = b.size(); n > 1; --n)
    for (std::size_t i = 0; i + 1 < n; ++i) b[i] += (b[i + 1] - b[i]) * t;
  return b[0];
}

Polynomial derivative(const Polynomial& b) {
  if (b.size() == 1) return {0};
  Polynomial d(b.size() - 1);
  for (std::size_t i = 0; i < d.size(); ++i) d[i] = static_cast<double>(d.size()) * (b[i + 1] - b[i]);
  return d;
}

// The parts over [0, t] and [t, 1], by de Casteljau.
std::pair<Polynomial, Polynomial> split(Polynomial b, double t) {
  Polynomial left(b.size());
  for (std::size_t n = b.size(); n > 0; --n) {
    left[b.size() - n] = b[0];
    for (std::size_t i = 0; i + 1 < n; ++i) b[i] += (b[i + 1] - b[i]) * t;
  }
  return {left, b};
}

Polynomial part(const Polynomial& b, double from, double to) {
  return split(split(b, to).first, to > 0 ? from / to : 0).second;
}

double binomial(std::size_t n, std::size_t k) {
  double result = 1;
  for (std::size_t i = 1; i <= k; ++i) result *= static_cast<double>(n - k + i) / static_cast<double>(i);
  return result;
}

Polynomial product(const Polynomial& a, const Polynomial& b) {
  const std::size_t m = a.size() - 1, n = b.size() - 1;
  Polynomial c(m + n + 1, 0);
  for (std::size_t i = 0; i <= m; ++i)
    for (std::size_t j = 0; j <= n; ++j)
      c[i + j] += binomial(m, i) * binomial(n, j) / binomial(m + n, i + j) * a[i] * b[j];
  return c;
}

Polynomial difference(Polynomial a, const Polynomial& b) {
  for (std::size_t i = 0; i < a.size(); ++i) a[i] -= b[i];
  return a;
}

// Appends the places in [from, to] where b may be zero: every root is within 1e-10 of one. A stretch on which
// b is nothing but rounding gets one place.
void append_roots(const Polynomial& b, double from, double to, double noise, std::vector<double>& roots) {
  const auto [low, high] = std::minmax_element(b.begin(), b.end());
  if (*low > noise || *high < -noise) return;
  if (to - from < 1e-10 || (*low >= -noise && *high <= noise)) {
    roots.push_back((from + to) / 2);
    return;
  }
  const auto [left, right] = split(b, 0.5);
  append_roots(left, from, (from + to) / 2, noise, roots);
  append_roots(right, (from + to) / 2, to, noise, roots);
}

struct Span {
  double from, to;                                    // curve parameters
  Polynomial x, y;                                    // over [from, to], x >= 0
  std::array<double, 2> tangent_first, tangent_last;  // unit
  std::array<double, 6> cx, cy;                       // in powers of w in [-1, 1]
};

struct Profile {
  double scale = 1, centre = 0;  // unit space is (x / scale, (y - centre) / scale)
  double orientation = 1;
  std::vector<Span> spans;
};

// The unit direction in which the curve leaves its first point, at a cusp too; zero for a curve without
// length.
std::array<double, 2> first_direction(const Polynomial& x, const Polynomial& y) {
  double longest = 0;
  for (std::size_t i = 1; i < x.size(); ++i)
    longest = std::max(longest, std::hypot(x[i] - x[0], y[i] - y[0]));
  for (std::size_t i = 1; i < x.size(); ++i) {
    const double length = std::hypot(x[i] - x[0], y[i] - y[0]);
    if (length > 1e-7 * longest) return {(x[i] - x[0]) / length, (y[i] - y[0]) / length};
  }
  return {0, 0};
}

// Powers of w of the degree-5 polynomial through b at the six Chebyshev-Lobatto points of [-1, 1], so that
// spans meet at their ends, and its largest distance from b at points between.
double fit(const Polynomial& b, std::array<double, 6>& c) {
  std::array<double, 6> node, value;
  for (int i = 0; i < 6; ++i) {
    node[i] = -std::cos(std::numbers::pi * i / 5);
    value[i] = evaluate(b, (node[i] + 1) / 2);
  }
  for (int order = 1; order < 6; ++order)  // divided differences
    for (int i = 5; i >= order; --i) value[i] = (value[i] - value[i - 1]) / (node[i] - node[i - order]);
  c = {};
  for (int i = 5; i >= 0; --i) {  // Newton's form to powers
    for (int k = 5; k > 0; --k) c[k] = c[k - 1] - node[i] * c[k];
    c[0] = -node[i] * c[0] + value[i];
  }
  if (b.size() <= 6) return 0;
  double worst = 0;
  for (int i = 0; i <= 24; ++i) {
    const double w = i / 12.0 - 1;
    double fitted = 0;
    for (int k = 5; k >= 0; --k) fitted = fitted * w + c[k];
    worst = std::max(worst, std::abs(fitted - evaluate(b, (w + 1) / 2)));
  }
  return worst;
}

constexpr double largest_fit_error = 2e-8;   // unit space; a third of float's rounding of 1
constexpr double largest_turn_cosine = 0.9;  // 26 degrees
constexpr double shortest_fitted = 1.0 / (1 << 16), shortest_turned = 1.0 / (1 << 12);

// Appends a piece of monotone x, y and direction, halved until it is flat and fits.
void append_spans(const Polynomial& x, const Polynomial& y, double from, double to,
                  std::vector<Span>& spans) {
  Span span{from, to, x, y, first_direction(x, y), {}, {}, {}};
  const std::array<double, 2> back =
      first_direction(Polynomial(x.rbegin(), x.rend()), Polynomial(y.rbegin(), y.rend()));
  span.tangent_last = {-back[0], -back[1]};
  const double turn_cosine =
      span.tangent_first[0] * span.tangent_last[0] + span.tangent_first[1] * span.tangent_last[1];
  const double error = std::max(fit(x, span.cx), fit(y, span.cy));
  const bool fits = error <= largest_fit_error || to - from < shortest_fitted;
  const bool flat = turn_cosine >= largest_turn_cosine || to - from < shortest_turned;
  if (fits && flat) {
    const double length = std::hypot(x.back() - x.front(), y.back() - y.front());
    const double radius = std::max(x.front(), x.back());
    if (length > 1e-9 && radius > 1e-9) spans.push_back(span);
    return;
  }
  const auto [x_left, x_right] = split(x, 0.5);
  const auto [y_left, y_right] = split(y, 0.5);
  append_spans(x_left, y_left, from, (from + to) / 2, spans);
  append_spans(x_right, y_right, (from + to) / 2, to, spans);
}

Profile make_profile(const CurvePoints& points) {
  Profile profile;
  Polynomial x, y;
  double radius = 0, low = points[0][1], high = low;
  for (const auto& p : points) {
    radius = std::max(radius, std::abs(p[0]));
    low = std::min(low, p[1]);
    high = std::max(high, p[1]);
  }
  profile.centre = (low + high) / 2;
  profile.scale = std::max(radius, (high - low) / 2);
  if (!(profile.scale > 0)) profile.scale = 1;
  for (const auto& p : points) {
    x.push_back(p[0] / profile.scale);
    y.push_back((p[1] - profile.centre) / profile.scale);
  }

  // Cuts: at the axis, where x or y turns, and at inflections.
  const Polynomial dx = derivative(x), dy = derivative(y);
  const Polynomial turning = difference(product(dx, derivative(dy)), product(dy, derivative(dx)));
  std::vector<double> cuts;
  for (const auto& p : {x, dx, dy, turning}) append_roots(p, 0, 1, 1e-13, cuts);
  cuts.push_back(1);
  std::sort(cuts.begin(), cuts.end());
  double from = 0, volume = 0;
  for (double to : cuts) {
    if (to - from < 1e-7 || (to < 1 && to > 1 - 1e-7)) continue;
    Polynomial piece_x = part(x, from, to);
    const Polynomial piece_y = part(y, from, to);
    if (evaluate(piece_x, 0.5) < 0)
      for (double& b : piece_x) b = -b;
    piece_x.front() = std::max(piece_x.front(), 0.0);
    piece_x.back() = std::max(piece_x.back(), 0.0);
    append_spans(piece_x, piece_y, from, to, profile.spans);
    from = to;
  }

  for (const Span& span : profile.spans) {  // of the solid of revolution, over pi
    const Polynomial integrand = product(product(span.x, span.x), derivative(span.y));
    for (double b : integrand) volume += b / static_cast<double>(integrand.size());
  }
  profile.orientation = volume < 0 ? -1 : 1;
  return profile;
}

// Whether `next` goes on where `span` ends, in about the same direction: no cusp, no reflection at the axis.
bool smooth(const Span& span, const Span& next) {
  const auto &a = span.tangent_last, &b = next.tangent_first;
  return span.to == next.from && a[0] * b[0] + a[1] * b[1] > 0.9;
}

}  // namespace

std::vector<float> curve_data(const CurvePoints& points) {
  const Profile profile = make_profile(points);
  const std::size_t count = profile.spans.size(), groups = (count + 7) / 8;
  constexpr std::size_t header = 8, group_size = 32, span_size = 24;
  std::vector<float> data(header + groups * group_size + count * span_size, 0.0f);
  const auto set = [&](std::size_t i, double value) { data[i] = static_cast<float>(value); };
  set(0, static_cast<double>(count));
  set(1, profile.scale);
  set(2, profile.centre);
  set(3, profile.orientation);
  constexpr double pad = 1e-6;  // unit space: several roundings of the ray's local coordinates
  for (std::size_t i = 0; i < groups * 8; ++i) {
    const std::size_t lane = header + i / 8 * group_size + i % 8;
    if (i >= count) {
      set(lane + 24, -1);  // no ray is within a negative squared radius
      continue;
    }
    const Span& span = profile.spans[i];
    const auto [y_low, y_high] = std::minmax(span.y.front(), span.y.back());
    const auto [x_low, x_high] = std::minmax(span.x.front(), span.x.back());
    set(lane, y_low - pad);
    set(lane + 8, y_high + pad);
    set(lane + 16, std::pow(std::max(x_low - pad, 0.0), 2));
    set(lane + 24, std::pow(x_high + pad, 2));
    const std::size_t first = header + groups * group_size + i * span_size;
    for (std::size_t k = 0; k < 6; ++k) {
      set(first + 2 * k, span.cx[k]);
      set(first + 2 * k + 1, span.cy[k]);
    }
    for (std::size_t k = 0; k < 2; ++k) {
      set(first + 12 + k, span.tangent_first[k]);
      set(first + 14 + k, span.tangent_last[k]);
    }
    set(first + 16, span.from);
    set(first + 17, span.to);
    set(first + 18, x_low == span.x.front() && x_low <= 0 ? 1 : i > 0 && smooth(profile.spans[i - 1], span));
    set(first + 19,
        x_low == span.x.back() && x_low <= 0 ? 1 : i + 1 < count && smooth(span, profile.spans[i + 1]));
  }
  return data;
}

CurveBounds curve_bounds(const CurvePoints& points) {
  const Profile profile = make_profile(points);
  double radius = 0, low = 0, high = 0;
  if (!profile.spans.empty()) low = high = profile.spans[0].y.front();
  for (const Span& span : profile.spans) {
    radius = std::max({radius, span.x.front(), span.x.back()});
    low = std::min({low, span.y.front(), span.y.back()});
    high = std::max({high, span.y.front(), span.y.back()});
  }
  constexpr double pad = 4e-6;
  radius = (radius + pad) * profile.scale;
  return {{-radius, (low - pad) * profile.scale + profile.centre, -radius},
          {radius, (high + pad) * profile.scale + profile.centre, radius}};
}

std::vector<float> curve_area_table(const CurvePoints& points, int segments) {
  Polynomial x, y;
  for (const auto& p : points) {
    x.push_back(p[0]);
    y.push_back(p[1]);
  }
  const Polynomial dx = derivative(x), dy = derivative(y);
  constexpr int steps = 16;  // midpoint rule within a segment
  std::vector<double> sums;
  double total = 0;
  for (int i = 0; i < segments * steps; ++i) {
    const double t = (i + 0.5) / (segments * steps);
    total += std::abs(evaluate(x, t)) * std::hypot(evaluate(dx, t), evaluate(dy, t));
    if (i % steps == steps - 1) sums.push_back(total);
  }
  std::vector<float> table{static_cast<float>(segments),
                           static_cast<float>(2 * std::numbers::pi * total / (segments * steps))};
  // Multiples of 2^-24, as the random numbers that choose a segment: its probability is then exactly what is
  // drawn.
  for (double sum : sums)
    table.push_back(total > 0 ? static_cast<float>(std::round(sum / total * 0x1p24) * 0x1p-24) : 1.0f);
  table.back() = 1;
  return table;
}

}  // namespace causticl
