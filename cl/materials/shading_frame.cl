// The two normals of a surface as a photon meets them, and the ways on which camera paths come to its direction at a
// specular surface: see adjoint_bsdf.cl.
#include "materials/scattering.cl"

// The normals on the side that a photon comes from, and their cosines with the direction that it came from and with each
// other.
typedef struct {
  real3 geometric, shading;
  real cosine_g, cosine_s, between;
} ShadingFrame;

INLINE ShadingFrame shading_frame(const Surface *surface, real3 direction) {
  ShadingFrame frame;
  real side = dot3(surface->geometric_normal, direction) < 0 ? 1 : -1;
  frame.geometric = scaled3(side, surface->geometric_normal);
  frame.shading = scaled3(side, surface->shading_normal);
  frame.cosine_g = -dot3(direction, frame.geometric);
  frame.cosine_s = -dot3(direction, frame.shading);
  frame.between = dot3(frame.geometric, frame.shading);
  return frame;
}

// Whether mirror_direction() reflects about Ns a camera path whose cosines with Ng and Ns are these.
INLINE bool reflects_about_shading(real cosine_g, real cosine_s, real between) {
  return cosine_s > 0 && 2 * cosine_s * between - cosine_g >= GRAZING_COSINE;
}

// The ways in which camera paths at a specular surface may come to a photon's direction, as what the photon has to carry
// on with each: by reflection and refraction about the normal of each kind.
typedef struct {
  real mirrored_s, mirrored_g, refracted_s, refracted_g;
  real cosine_t_s, cosine_t_g;  // of the refracted directions
  real eta;                     // index beyond over that on the photon's side, by which refraction bends
  real tint_cosine_g;           // with which the path that is mirrored about Ng sees the surface
  real through_cosine_g;        // and that which is refracted about Ng
} SpecularWays;
