// Every material of MATERIAL_TABLE but Lambert's: diffuse.cl, which samples all that are diffuse.
#include "materials/conductor.cl"
#include "materials/glass.cl"
#include "materials/mirror.cl"
#include "materials/oren_nayar.cl"
#include "materials/plastic.cl"
#include "materials/thin_glass.cl"
