#include "render/film_merge.h"

#include <algorithm>
#include <filesystem>
#include <memory>

#include "base/error.h"
#include "image/exr_rows.h"
#include "render/film_layers.h"
#include "render/film_partial.h"

namespace drude {

namespace {

using Readers = std::vector<std::unique_ptr<PartialReader>>;

std::string samples_of(const FilmPart& part, uint32_t first, uint32_t last) {
    const auto size = static_cast<uint64_t>(part.job.batch_size);
    return fmt::format("{}:{}", first * size, last * size);
}

void check_one_picture(const Readers& readers, bool allow_mixed) {
    const PartialReader& a = *readers.front();
    for (const auto& b : readers) {
        std::string differences = job_differences(a.part().job, b->part().job, true);
        if (differences.empty() && a.part().batches != b->part().batches) {
            const auto total = [](const FilmPart& part) {
                return part.batches == 0
                           ? std::string("an open number of")
                           : fmt::format("{}",
                                         part.batches * static_cast<uint64_t>(part.job.batch_size));
            };
            differences = fmt::format("a picture of {} samples against {}", total(a.part()),
                                      total(b->part()));
        }
        if (!differences.empty()) {
            user_error("{} and {}: are not parts of one picture: {}", a.path(), b->path(),
                       differences);
        }
        const std::string& set_a = a.part().job.instruction_set;
        const std::string& set_b = b->part().job.instruction_set;
        if (set_a != set_b && !allow_mixed) {
            user_error(
                "{} and {}: were rendered with the instruction sets {} and {}, whose bits differ; "
                "accept the mixture with --allow-mixed",
                a.path(), b->path(), set_a, set_b);
        }
    }
}

// Sorted by their first batches; throws where two hold the same.
void sort_and_check_overlaps(Readers* readers) {
    std::stable_sort(readers->begin(), readers->end(), [](const auto& a, const auto& b) {
        return std::pair(a->part().first, a->part().last) <
               std::pair(b->part().first, b->part().last);
    });
    const PartialReader* before = nullptr;
    for (const auto& reader : *readers) {
        const FilmPart& part = reader->part();
        if (part.first == part.last) continue;  // a shard of a picture with few samples
        if (before && part.first < before->part().last) {
            user_error("{} and {}: overlap: samples {} and {} of each pixel; name each part once",
                       before->path(), reader->path(),
                       samples_of(before->part(), before->part().first, before->part().last),
                       samples_of(part, part.first, part.last));
        }
        before = reader.get();
    }
}

// What the parts are together, and what is missing of the whole.
MergeResult joined(const Readers& readers) {
    MergeResult result;
    FilmPart& whole = result.part;
    whole = readers.front()->part();
    whole.fewest = 0;
    whole.counts = {};
    std::string gaps;
    uint32_t reached = 0;
    const auto gap = [&](uint32_t first, uint32_t last) {
        if (first >= last) return;
        gaps += (gaps.empty() ? "" : ", ") + samples_of(whole, first, last);
    };
    for (const auto& reader : readers) {
        const FilmPart& part = reader->part();
        whole.fewest += part.fewest;
        whole.counts += part.counts;
        whole.last = std::max(whole.last, part.last);
        whole.job.instruction_set =
            joined_instruction_sets(whole.job.instruction_set, part.job.instruction_set);
        if (part.first == part.last) continue;
        gap(reached, part.first);
        // Of an unfinished part the end is missing, if not in every pixel.
        if (part.batches > 0) gap(part.first + part.fewest, part.last);
        reached = part.last;
    }
    gap(reached, whole.batches);
    if (!gaps.empty()) {
        result.warnings.push_back(fmt::format(
            "samples {} of each pixel are missing; the picture has {} instead of {}", gaps,
            whole.fewest * static_cast<uint64_t>(whole.job.batch_size),
            std::max(whole.batches, reached) * static_cast<uint64_t>(whole.job.batch_size)));
    }
    if (whole.batches > whole.fewest) result.missing = whole.batches - whole.fewest;
    return result;
}

}  // namespace

MergeResult merge_partials(const std::vector<std::string>& parts, const std::string& output,
                           bool allow_mixed, const std::string& command_line) {
    Readers readers;
    for (const std::string& path : parts) {
        std::error_code error;
        if (std::filesystem::equivalent(path, output, error)) {
            user_error("-o {}: is a part that is merged; name another file", output);
        }
        readers.push_back(std::make_unique<PartialReader>(path));
    }
    check_one_picture(readers, allow_mixed);
    sort_and_check_overlaps(&readers);
    MergeResult result = joined(readers);
    const FilmPart& whole = result.part;
    if (whole.fewest == 0) {
        user_error(
            "{}: there are pixels without any sample; finish {} first (the same command with "
            "--resume)",
            parts.front(), parts.size() == 1 ? "it" : "one of the parts");
    }

    const FilmLayers layers(whole.job.layout(), whole.fewest >= 2);
    ExrPicture picture;
    picture.width = whole.job.width;
    picture.height = whole.job.height;
    picture.channels = layers.channels();
    picture.attributes = picture_attributes(whole.job, whole.first, whole.fewest);
    picture.attributes["commandLine"] = command_line;
    FilmLayout one_row = whole.job.layout();
    one_row.height = 1;
    FilmSums row(one_row);
    write_exr_rows(output, picture, Compression::piz, [&](int y, uint32_t* words) {
        FilmSums sums(one_row);
        for (const auto& reader : readers) {
            reader->read_row(y, &row, 0);
            for (size_t x = 0; x < one_row.pixels(); ++x) {
                if (!sums.add(x, row, x)) {
                    user_error("{}: more than {} batches a pixel together", output, most_terms);
                }
            }
        }
        layers.row(sums, 0, words);
    });
    const std::vector<std::string> more = count_warnings(whole.counts);
    result.warnings.insert(result.warnings.end(), more.begin(), more.end());
    return result;
}

}  // namespace drude
