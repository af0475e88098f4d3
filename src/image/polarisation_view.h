// Pictures of polarisation, from the Stokes vectors of a finished picture.
#pragma once

#include <optional>
#include <vector>

#include "image/colour_map.h"
#include "image/picture.h"
#include "image/stokes_layer.h"

namespace drude {

// With P = sqrt(S1^2 + S2^2): dop sqrt(P^2 + S3^2)/S0, dolp P/S0, docp |S3|/S0, aolp
// 1/2 atan2(S2, S1) in degrees within [0, 180), counter-clockwise from the picture's horizontal;
// s0 to s3 the components themselves.
enum class PolarisationView { dop, dolp, docp, aolp, s0, s1, s2, s3 };

// Whether a layer needs its S3 for this.
bool needs_s3(PolarisationView view);

// A value a pixel. NaN where there is none: a component that is not finite; degrees and angle also
// where S0 <= 0 (no light), the angle where P = 0 (no direction). Noise and colours outside Rec.709
// can give degrees above 1, which stay. std::logic_error for a layer without the S3 it needs.
std::vector<double> view_values(const StokesLayer& layer, PolarisationView view);

// The degree of linear polarisation from which an angle is shown in its full colour; towards 0 it
// fades to grey, since the angle of unpolarised light is that of its noise.
inline constexpr double full_colour_dolp = 0.1;

// Degrees from 0 to `range` (1 unless given), s0 from 0 to `range`, s1 to s3 from -range to range;
// the angle always from 0 to 180. The range of components, unless given, is what 99.5 % of the
// pixels' magnitudes do not exceed (nearest rank), rounded up to two digits, so that fireflies do
// not set it; 1 where all of them are 0. A range that is given must be above 0 and finite.
ColourBar view_bar(PolarisationView view, const std::vector<double>& values,
                   std::optional<double> range);

// The values through the bar's map, NaN as the middle grey of the cyclic map.
Picture view_picture(const StokesLayer& layer, PolarisationView view,
                     const std::vector<double>& values, const ColourBar& bar);

}  // namespace drude
