// The lights of LIGHT_TABLE, one file each, and those that objects are.
#include "lights/area_light.cl"
#include "lights/directional.cl"
#include "lights/environment.cl"
#include "lights/point.cl"
#include "lights/rectangle.cl"
#include "lights/spot.cl"
