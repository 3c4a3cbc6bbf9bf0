// Reflectance of a smooth boundary, unpolarised light.
#include "core/prelude.cl"

// Reflectance of unpolarised light at a smooth boundary; `cosine` is that of the angle of incidence, eta the
// index beyond over the index before the boundary. Sets *cosine_t, that of the refracted angle; total
// reflection returns 1 and leaves it 0. (Born & Wolf, section 1.5.2)
INLINE real fresnel_dielectric(real cosine, real eta, real *cosine_t) {
  cosine = clamp(cosine, (real)0, (real)1);
  // eta^2 - sin^2 in a form that cancels nothing: grazing rays and nearly equal indices stay exact.
  real square = (eta - 1) * (eta + 1) + cosine * cosine;
  // Between equal indices nothing is reflected or bent, also at grazing incidence, where the square underflows.
  *cosine_t = eta == 1 ? cosine : 0;
  if (square <= 0) return eta == 1 ? 0 : 1;
  real c = sqrt(square) / eta;
  *cosine_t = fmin(c, (real)1);
  real parallel = (eta * cosine - c) / (eta * cosine + c);
  real perpendicular = (cosine - eta * c) / (cosine + eta * c);
  // Divisions need not be exact: OpenCL allows 2.5 ulp, by which a sum of squares can pass 1.
  return fmin((real)0.5 * (parallel * parallel + perpendicular * perpendicular), (real)1);
}

// Fraction of the light that a smooth boundary to the index `eta` lets through.
INLINE real fresnel_transmittance(real cosine, real eta) {
  real cosine_t;
  return 1 - fresnel_dielectric(cosine, eta, &cosine_t);
}

// The same boundary to a conductor of the relative complex index eta + i k, one channel (Born & Wolf, section
// 14.2). With the refracted wave's a + i b = sqrt((eta + i k)^2 - sin^2), every term is a sum of squares: nothing
// cancels, and the result is in [0, 1].
INLINE real fresnel_conductor(real cosine, real eta, real k) {
  cosine = clamp(cosine, (real)0, (real)1);
  real sine2 = (1 - cosine) * (1 + cosine);
  // eta^2 - k^2 - sin^2 by whichever of sine and cosine is small: between nearly equal indices at grazing incidence,
  // or near total reflection at a small eta, the other would cancel all digits.
  real difference =
      cosine < (real)0.5 ? (eta - 1) * (eta + 1) + cosine * cosine - k * k : (eta - k) * (eta + k) - sine2;
  real product = eta * k;
  // The larger of a^2 and b^2 by a sum, the smaller by their product.
  real larger = (real)0.5 * (sqrt(difference * difference + 4 * product * product) + fabs(difference));
  real smaller = larger > 0 ? product * product / larger : 0;
  real a = sqrt(difference >= 0 ? larger : smaller), b2 = difference >= 0 ? smaller : larger;
  real near = a - cosine, far = a + cosine;
  real denominator = far * far + b2;
  // At grazing incidence between equal indices nothing is reflected.
  if (!(denominator > 0)) return 0;
  real perpendicular = (near * near + b2) / denominator;
  near = a * cosine - sine2;
  far = a * cosine + sine2;
  real parallel = perpendicular * (near * near + b2 * cosine * cosine) / (far * far + b2 * cosine * cosine);
  return (real)0.5 * (perpendicular + parallel);
}
