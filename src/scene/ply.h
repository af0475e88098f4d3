// Triangles from a PLY file (Stanford polygon format 1.0): ascii, little and big endian.
#pragma once

#include <string>
#include <string_view>

#include "scene/messages.h"
#include "scene/scene.h"

namespace drude {

// Reads `bytes` (already unpacked); `file` names it in errors. Takes x y z, nx ny nz and uv (u v,
// s t, texture_u texture_v, texture_s texture_t) of "vertex" and the polygons of "face"
// (vertex_indices, vertex_index); quads and larger polygons become fans of triangles; everything
// else is passed over. Errors (user) name file and line (ascii) or file and byte (binary): a header
// that makes no sense, counts that the file cannot hold, indices out of range, numbers that are not
// finite, a file without faces. Memory is never claimed for more than the bytes could describe.
TriangleMesh parse_ply(std::string_view bytes, const std::string& file, Messages& messages);

}  // namespace drude
