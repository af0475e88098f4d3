// drude merge: shards and checkpoints to a picture.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <memory>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "cli/command_list.h"
#include "cli/json_output.h"
#include "cli/warnings.h"
#include "image/image.h"
#include "render/film_merge.h"
#include "render/transport_choice.h"

namespace drude {

namespace {

struct Options {
    std::vector<std::string> parts;
    std::string output;
    bool allow_mixed = false;
};

int run(const Options& options, const CommonOptions& common) {
    if (options.output.empty()) user_error("merge: no output; name the picture with -o OUT.exr");
    expect_exr_name("merge", options.output);
    const MergeResult result =
        merge_partials(options.parts, options.output, options.allow_mixed,
                       fmt::format("{}", fmt::join(common.command_line, " ")));
    print_warnings(result.warnings);
    const FilmPart& part = result.part;
    const auto size = static_cast<uint64_t>(part.job.batch_size);
    if (common.json) {
        print_json_document(nlohmann::json{{"output", options.output},
                                           {"parts", options.parts.size()},
                                           {"spp", part.fewest * size},
                                           {"missing_spp", result.missing * size},
                                           {"rays", part.counts.rays},
                                           {"render_seconds", part.counts.seconds},
                                           {"transport", transport_name(part.job.transport)},
                                           {"warnings", result.warnings}});
    } else {
        fmt::print("{}: {} samples a pixel of {} part{}\n", options.output, part.fewest * size,
                   options.parts.size(), options.parts.size() == 1 ? "" : "s");
    }
    return 0;
}

}  // namespace

Command merge_command() {
    Command command;
    command.name = "merge";
    command.summary = "Join the shards of a picture";
    command.description =
        "Joins files of exact sums, which drude render --shard wrote or an interrupted render left "
        "as its checkpoint, to one picture: bit by bit that of one render of all their samples. "
        "Parts that overlap or that are of different scenes, seeds, options, versions or "
        "instruction sets are refused with what differs; samples that are missing are said, and "
        "the picture has fewer.\n\n"
        "--allow-mixed joins parts of different instruction sets, whose bits differ.";
    command.example =
        "drude render scene.pbrt --shard 0/2 -o part-0.exr\n"
        "drude render scene.pbrt --shard 1/2 -o part-1.exr\n"
        "drude merge part-0.exr part-1.exr -o OUT.exr";
    command.declare = [](OptionSet& set, const CommonOptions& common) {
        const auto options = std::make_shared<Options>();
        set.positionals("PART", options->parts, "files of sums", 1);
        set.option("-o,--output", options->output, "the EXR to write");
        set.flag("--allow-mixed", options->allow_mixed,
                 "also parts of different instruction sets, whose bits differ");
        return [options, &common] { return run(*options, common); };
    };
    return command;
}

}  // namespace drude
