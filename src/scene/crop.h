// A picture of which only a part is rendered.
//
// The part is a picture of its own: the film has its size, the camera's window is cut to it, and
// what the film forgets by that stands in Film::Crop. So nothing behind the scene reader has to
// know of it.
#pragma once

#include "scene/scene.h"

namespace drude {

// Cuts the picture to the pixels x0 <= x < x1, y0 <= y < y1 of the whole, 0 at the upper left.
// The ranges must lie within the film and hold a pixel.
void crop_picture(int x0, int x1, int y0, int y1, Film* film, Camera* camera);
// The whole picture again; nothing happens where it is not cropped.
void uncrop_picture(Film* film, Camera* camera);

}  // namespace drude
