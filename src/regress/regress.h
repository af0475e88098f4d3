// Did any picture change? Renders every case of a manifest anew and holds it against its reference
// with the noise test of image/noise_test.h.
//
// The probability of any false alarm of one whole run is the manifest's alpha: each case spends
// its share by Sidak's rule, and so do, within a case, the pixels, blocks and means of its
// channels. What decides is the picture: a scene or a material file that differs from the one that
// the reference was rendered from is told, and judged by what it looks like.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/error.h"
#include "image/compare.h"
#include "regress/manifest.h"

namespace drude {

struct RegressOptions {
    std::vector<std::string>
        only;                      // names of cases; a trailing * stands for any ending; empty: all
    std::optional<uint64_t> seed;  // in place of every case's own
    int threads = 0;
    bool quiet = false;
};

enum class CaseStatus {
    passed,
    failed,   // another picture, or contributions that the renderer itself calls a defect
    weak,     // the same as far as can be seen, but a bias of largest_bias could not be seen; a
              // picture without light is such a one
    missing,  // there is no reference
    error,    // the scene cannot be rendered, or the reference cannot be compared or is not the
              // one that the manifest describes (seed, samples)
    skipped,  // interrupted before its turn
};
// "passed", "failed", ...
std::string_view status_word(CaseStatus status);

struct CaseResult {
    ReferenceCase declared;
    CaseStatus status = CaseStatus::skipped;
    std::string message;         // one line for people
    Cause cause = Cause::user;   // of an error
    bool scene_changed = false;  // its hash is not the one that the reference was rendered from
    uint64_t seed = 0;           // of the new picture
    double detectable_bias = 0;  // of a mean of S0, as a fraction of it
    double seconds = 0;
    std::optional<Comparison> comparison;
    Image rendered, reference;  // without pixels where there is none
    std::string render_command, compare_command, update_command;

    bool good() const { return status == CaseStatus::passed; }
};

struct RegressResult {
    double alpha = 0, alpha_each = 0;  // of the run, of one case
    double seconds = 0;
    std::vector<CaseResult> cases;  // in the manifest's order
    size_t count(CaseStatus status) const;
    // Everything that is no pass and not skipped.
    size_t failed() const;
};

// Throws Error (user) for a name in `only` that fits no case, and a seed that is some case's
// reference_seed. What is wrong with one case alone is that case's result. An interrupt leaves the
// cases that were not reached skipped.
RegressResult run_regress(const ReferenceManifest& manifest, const RegressOptions& options);

// Renders the reference of one case and writes it beside the manifest; adds to its history. The
// manifest itself is the caller's to write. Throws Error, leaving the reference as it was, also
// where the renderer reports contributions that are not finite or not physical.
void update_reference(const ReferenceManifest& manifest, ReferenceCase* one, const std::string& why,
                      int threads, bool quiet);

// The channels that a case compares: S0.R to S3.B, or R, G, B.
std::vector<std::string> reference_channels(bool stokes);

}  // namespace drude
