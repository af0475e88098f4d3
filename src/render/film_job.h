// What a film holds: of which picture, and which of its batches.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "image/image.h"
#include "render/film_sums.h"
#include "render/throughput.h"

namespace drude {

// Everything that decides the bits of a batch of a pixel. Sums of equal jobs, and only these, are
// sums of one picture.
struct FilmJob {
    std::string scene_hash;
    int width = 0, height = 0;
    uint64_t seed = 0;
    int batch_size = 16;
    int max_depth = 0;
    Transport transport = Transport::scalar;
    int wavelengths = 8;
    bool spectral = false;
    std::string analyser;  // before the camera; empty: none
    std::string crop;      // which part of a larger picture it is; empty: all of it
    std::string instruction_set, version;

    FilmLayout layout() const;
    // All of it as names and values for files and people, the instruction set last.
    std::vector<std::pair<std::string, std::string>> fields() const;
};

// "seed 1 against 2, transport stokes against scalar"; "" where the jobs are equal. A difference
// in the instruction set counts unless `allow_mixed`.
std::string job_differences(const FilmJob& a, const FilmJob& b, bool allow_mixed);

// The instruction sets of sums that were added up, each named once.
std::string joined_instruction_sets(const std::string& a, const std::string& b);

// Counts of what happened to the batches; they add up as the batches do.
struct FilmCounts {
    uint64_t rays = 0;
    uint64_t projections = 0, not_finite = 0;  // see PathStatistics; both should be 0
    uint64_t out_of_range = 0;                 // batches that held infinity: also 0
    double seconds = 0;                        // of rendering

    FilmCounts& operator+=(const FilmCounts& other);
};

// Batches [first, last) of each pixel, of the `batches` that the whole picture has (0: as many as
// an error or a time asks for). A pixel may hold fewer so far: those from `first` on.
struct FilmPart {
    FilmJob job;
    uint32_t batches = 0;
    uint32_t first = 0, last = 0;
    uint32_t fewest = 0;  // that any pixel holds
    FilmCounts counts;
};

// The attributes of a picture made of `fewest` batches a pixel or more, from batch `first` on.
std::map<std::string, Attribute> picture_attributes(const FilmJob& job, uint32_t first,
                                                    uint32_t fewest);

// What a user should know of counts that should be 0. Where the scene has plugins, they are the
// first to be asked.
std::vector<std::string> count_warnings(const FilmCounts& counts,
                                        const std::vector<std::string>& plugins = {});

}  // namespace drude
