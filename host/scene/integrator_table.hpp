// The integrators: one row each. What an integrator does is one file more, host/integrators/NAME.cpp.
#pragma once

// Columns: its word in a scene's `type` and of --integrator; other spellings of that, without what joins
// words; its name in text; the field of RendererSpec, with an option of the same name, that counts its
// passes: `samples` where each is one sample a pixel and quick, else `passes`; its programs (rows of
// PASS_TABLE in cl/shared/passes.h) in the order of their first use; how its MSE goes down with the number of
// passes in the long run, as the exponent (photon mapping: Knaus & Zwicker 2011).
//
// The file of a row holds the functions that integrators/integrators.hpp declares for it: how it is made, the
// rates at which its error is expected to go down, and what `info` says of it. A row without them does not
// link.
#define INTEGRATOR_TABLE(ROW)                                                                    \
  ROW(sppm, "photon photons photonmap photonmapper photonmapping ppm", "photon mapping", passes, \
      "photon camera grid gather film", -2.0 / 3)                                                \
  ROW(pt, "path paths pathtracer pathtracing", "path tracing", samples, "path film", -1.0)
