// Joining shards and checkpoints to a picture.
#pragma once

#include <string>
#include <vector>

#include "render/film_job.h"

namespace drude {

struct MergeResult {
    FilmPart part;  // of all parts together; batches that are missing lie between first and last
    uint32_t missing = 0;  // batches a pixel, where the parts say how many the picture has
    std::vector<std::string> warnings;
};

// Writes the picture of the batches of all `parts` to `output`, row by row: no film stands in
// memory. The picture is that of one render with these batches, bit by bit. Batches that are
// missing are fewer samples and a warning.
// Throws Error (user) for parts that overlap, that are of different scenes, seeds, options or
// versions (instruction sets too, unless `allow_mixed`), with what differs, that are damaged, or
// that leave a pixel without a sample; Error (outside) where the disk says no.
MergeResult merge_partials(const std::vector<std::string>& parts, const std::string& output,
                           bool allow_mixed, const std::string& command_line);

}  // namespace drude
