// What three channels make of a metal's colour, without any noise.
#pragma once

#include "bench/charts/bench_item.h"
#include "bench/charts/illuminants.h"
#include "bench/charts/rgb_metal.h"

namespace drude {

// The mean over a sphere's visible half (cos_theta^2 uniform) of CIEDE2000 between light that a
// mirror of the metal reflects `times` times at one angle, and what the channels make of it. White
// is that of sRGB, of the light's luminance.
double rgb_colour_error(const DenseIndex& metal, RgbMetal way, const ChartIlluminant& light,
                        int times);

// Metals by illuminants, for each way, after one reflection and after three.
BenchTable rgb_error_table();

}  // namespace drude
