// The effects that a scene can call for: one bit each, seen by the host's analysis and by the kernels.
// EFFECTS is prepended to every program as one #define; kernels ask `if (HAS(EFFECT_GLASS))`, never #if, so
// that every branch is type-checked in every build and the compiler removes what no scene object needs.
#pragma once

#define EFFECT_TRIANGLES (1u << 0)   // meshes, rectangles, boxes
#define EFFECT_SPHERES (1u << 1)
#define EFFECT_PLANES (1u << 2)
#define EFFECT_DISKS (1u << 3)
#define EFFECT_BEZIER (1u << 4)      // revolved Bezier curves
#define EFFECT_TEXTURES (1u << 5)
#define EFFECT_MIRROR (1u << 6)
#define EFFECT_GLASS (1u << 7)
#define EFFECT_LENS (1u << 8)        // a lens of non-zero radius
#define EFFECT_SHADOW_RAYS (1u << 9) // direct light by shadow rays

#define EFFECT_ROUGH (1u << 10)      // glass, conductors or coated diffuse with roughness
#define EFFECT_CONDUCTOR (1u << 11)
#define EFFECT_PLASTIC (1u << 12)

#define EFFECT_ENVIRONMENT (1u << 13)   // light from beyond the scene
#define EFFECT_DELTA_LIGHTS (1u << 14)  // point, spot and directional lights

#define EFFECT_ABSORPTION (1u << 15) // glass that absorbs
#define EFFECT_DISPERSION (1u << 16) // glass whose index depends on the wavelength
#define EFFECT_MOTION (1u << 17)     // objects that move while the shutter is open
#define EFFECT_MEDIUM (1u << 18)     // a medium that fills the scene

#define EFFECT_GUIDED_PHOTONS (1u << 19) // photons guided to what the camera sees

#define EFFECT_AIMED_PHOTONS (1u << 20)  // photons aimed at what focuses them

#define EFFECT_SMOOTH (1u << 21)   // triangles with shading normals
#define EFFECT_SLIVERS (1u << 22)  // triangles too thin for the cross product of their edges

#define EFFECT_NESTED (1u << 23)   // dielectrics that touch, overlap, or hold the camera or emitters
#define EFFECT_WALLS (1u << 24)    // surfaces that may part photons from visible points

#define EFFECT_HORIZON (1u << 25)  // light from beyond the scene on infinite planes

#define EFFECT_ALL ((1u << 26) - 1u)

// Compiled in like an effect, but asked for by the user and by no scene.
#define OUTPUT_LIGHT_PASSES (1u << 31)  // the layers of light_passes.cl beside the picture

#define HAS(effect) ((EFFECTS & (effect)) != 0u)
