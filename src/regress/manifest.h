// The list of references: which scene is rendered how, what it is there for, what it must reveal.
//
// tests/references/manifest.json ("drude-references/1"):
//   alpha             probability of any false alarm of one whole run
//   cases[].name      also the name of the reference, NAME.exr beside the manifest
//   cases[].scene     a pbrt scene, relative to the manifest
//   cases[].purpose   one sentence for people
//   cases[].samples, seed                      of the picture that every run renders
//   cases[].reference_samples, reference_seed  of the reference; the seeds must differ, and the
//                     samples of both be 32 or more: two batches of 16, alike in both pictures
//   cases[].largest_bias   the run must be able to see a bias of this fraction of the mean S0; a
//                          comparison too noisy for it fails
//   cases[].wavelengths (0: the renderer's choice), transport ("stokes": S0..S3 are compared,
//   "auto": R, G, B), resolution ("WxH"): optional, as the options of `drude render`
//   cases[].history   when, with which version and why the reference was rendered
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace drude {

struct ReferenceUpdate {
    std::string date;  // ISO 8601, UTC
    std::string version;
    std::string why;
};

struct ReferenceCase {
    std::string name, scene, purpose;
    int samples = 0, reference_samples = 0;
    uint64_t seed = 0, reference_seed = 0;
    double largest_bias = 0;
    int wavelengths = 0;
    bool stokes = true;
    std::string resolution;  // empty: the scene's own
    std::vector<ReferenceUpdate> history;
};

struct ReferenceManifest {
    std::string folder;
    double alpha = 1e-5;
    std::vector<ReferenceCase> cases;

    std::string path() const { return folder + "/manifest.json"; }
    std::string scene_path(const ReferenceCase& one) const;
    std::string reference_path(const ReferenceCase& one) const {
        return folder + "/" + one.name + ".exr";
    }
};

// Throws Error (user) with file:line:column for syntax, unknown or missing keys, values out of
// range, names used twice or unfit for a file, equal seeds, and an empty list.
ReferenceManifest read_manifest(const std::string& folder);
// Round trip: what was read is written with the same meaning, in the order of the cases.
void write_manifest(const ReferenceManifest& manifest);

}  // namespace drude
