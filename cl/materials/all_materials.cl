// Every material of MATERIAL_TABLE.
#include "materials/conductor.cl"
#include "materials/diffuse.cl"
#include "materials/glass.cl"
#include "materials/mirror.cl"
#include "materials/plastic.cl"
#include "materials/thin_glass.cl"
