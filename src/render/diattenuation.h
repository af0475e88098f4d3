// How strongly the surfaces of a scene polarise, and what light without polarisation gets wrong.
#pragma once

#include "scene/scene.h"

namespace drude {

// The largest |B|/A, |Rs - Rp|/(Rs + Rp), of any surface in the scene at any angle of incidence and
// any wavelength of the film's range, for films without their averages; 1 for clear materials,
// elements and plugins. In [0, 1].
double largest_diattenuation(const Scene& scene);

}  // namespace drude
