#include "scene/old_versions.h"

#include <algorithm>
#include <array>
#include <string>
#include <vector>

namespace drude {

namespace {

enum Version { v2 = 1, v3 = 2, both = 3 };

struct OldWord {
    std::string_view directive;  // "" where the word itself is a directive or a type
    std::string_view word;
    Version versions;
    std::string_view now;  // what pbrt-v4 has instead
};

constexpr std::array old_directives = {
    OldWord{"", "WorldEnd", both, "leave WorldEnd out"},
    OldWord{"", "Renderer", v2, "Renderer becomes Integrator \"path\""},
    OldWord{"", "SurfaceIntegrator", v2, "SurfaceIntegrator becomes Integrator \"path\""},
    OldWord{"", "VolumeIntegrator", v2, "VolumeIntegrator becomes Integrator \"volpath\""},
    OldWord{"", "Volume", v2, "Volume becomes MakeNamedMedium and MediumInterface"},
    OldWord{"", "AreaLight", v2, "AreaLight becomes AreaLightSource"},
};

constexpr std::array old_types = {
    OldWord{"", "color", both, "\"color X\" becomes \"rgb X\" (in Texture: \"spectrum\")"},
    OldWord{"", "xyz", both, "\"xyz X\" becomes \"rgb X\""},
};

constexpr std::array old_names = {
    OldWord{"Film", "image", both, "Film \"image\" becomes Film \"rgb\""},
    OldWord{"Camera", "environment", both, "Camera \"environment\" becomes Camera \"spherical\""},
    OldWord{"Sampler", "lowdiscrepancy", both, "Sampler \"lowdiscrepancy\" becomes \"zsobol\""},
    OldWord{"Sampler", "02sequence", v3, "Sampler \"02sequence\" becomes \"zsobol\""},
    OldWord{"Sampler", "maxmindist", v3, "Sampler \"maxmindist\" becomes \"zsobol\""},
    OldWord{"Sampler", "random", both, "Sampler \"random\" becomes \"independent\""},
    OldWord{"Sampler", "adaptive", v2, "Sampler \"adaptive\" becomes \"zsobol\""},
    OldWord{"Sampler", "bestcandidate", v2, "Sampler \"bestcandidate\" becomes \"zsobol\""},
    OldWord{"Integrator", "directlighting", v3, "Integrator \"directlighting\" becomes \"path\""},
    OldWord{"Integrator", "whitted", v3, "Integrator \"whitted\" becomes \"path\""},
    OldWord{"Accelerator", "grid", v2, "Accelerator \"grid\" becomes \"bvh\""},
    OldWord{"AreaLightSource", "area", both, "AreaLightSource \"area\" becomes \"diffuse\""},
    OldWord{"LightSource", "exinfinite", v2, "LightSource \"exinfinite\" becomes \"infinite\""},
    OldWord{"Shape", "cone", both, "Shape \"cone\" becomes a mesh"},
    OldWord{"Shape", "hyperboloid", both, "Shape \"hyperboloid\" becomes a mesh"},
    OldWord{"Shape", "paraboloid", both, "Shape \"paraboloid\" becomes a mesh"},
    OldWord{"Shape", "heightfield", both, "Shape \"heightfield\" becomes a mesh"},
    OldWord{"Shape", "nurbs", both, "Shape \"nurbs\" becomes a mesh"},
    OldWord{"Texture", "color", both, "Texture \"...\" \"color\" becomes \"spectrum\""},
    OldWord{"Material", "matte", both, "Material \"matte\" becomes \"diffuse\" (Kd: reflectance)"},
    OldWord{"Material", "metal", both, "Material \"metal\" becomes \"conductor\""},
    OldWord{"Material", "shinymetal", v2, "Material \"shinymetal\" becomes \"conductor\""},
    OldWord{"Material", "mirror", both, "Material \"mirror\" becomes \"conductor\""},
    OldWord{"Material", "glass", both, "Material \"glass\" becomes \"dielectric\""},
    OldWord{"Material", "plastic", both, "Material \"plastic\" becomes \"coateddiffuse\""},
    OldWord{"Material", "substrate", both, "Material \"substrate\" becomes \"coateddiffuse\""},
    OldWord{"Material", "uber", both, "Material \"uber\" becomes \"coateddiffuse\""},
    OldWord{"Material", "disney", v3, "Material \"disney\" becomes \"coateddiffuse\""},
    OldWord{"Material", "fourier", v3, "Material \"fourier\" becomes \"measured\""},
    OldWord{"Material", "kdsubsurface", both, "Material \"kdsubsurface\" becomes \"subsurface\""},
    OldWord{"Material", "translucent", both,
            "Material \"translucent\" becomes \"diffusetransmission\""},
    OldWord{"Material", "none", v3, "Material \"none\" becomes \"interface\""},
};

template <size_t N>
const OldWord* find(const std::array<OldWord, N>& words, std::string_view directive,
                    std::string_view word) {
    for (const OldWord& old : words) {
        if (old.directive == directive && old.word == word) return &old;
    }
    return nullptr;
}

// Everything old in a file: what changes, and which versions had all of it.
struct Findings {
    struct Change {
        const OldWord* old;
        int line;
    };
    std::vector<Change> changes;
    int versions = both;

    void add(const OldWord* old, int line) {
        if (old == nullptr) return;
        versions &= old->versions;
        for (const Change& change : changes) {
            if (change.old == old) return;
        }
        changes.push_back({old, line});
    }
};

Findings examine(const Lexer& lexer) {
    Findings findings;
    bool integrator = false;
    try {
        Lexer again(lexer.source());
        std::string_view directive, previous;
        int strings = 0;  // since the directive
        for (Token token = again.take(); token.kind != Token::Kind::end; token = again.take()) {
            if (token.kind == Token::Kind::word) {
                findings.add(find(old_directives, "", token.text), token.line);
                directive = token.text;
                strings = 0;
                if (directive == "Integrator" || directive == "MediumInterface") integrator = true;
            } else if (token.kind == Token::Kind::string) {
                ++strings;
                // Texture "name" "type" "class", everything else "name" first.
                if (strings == 1 || (directive == "Texture" && strings == 2)) {
                    findings.add(find(old_names, directive, token.text), token.line);
                }
                if (directive == "MakeNamedMaterial" && previous == "string type") {
                    findings.add(find(old_names, "Material", token.text), token.line);
                }
                previous = token.text;
                const std::string_view type = token.text.substr(0, token.text.find_first_of(" \t"));
                if (type.size() < token.text.size()) {
                    findings.add(find(old_types, "", type), token.line);
                }
            }
        }
    } catch (const Error&) {
        // Not even tokens any more: what was found up to here serves.
    }
    if (integrator && (findings.versions & v3)) findings.versions = v3;
    return findings;
}

}  // namespace

bool is_old_directive(std::string_view word) {
    return find(old_directives, "", word) != nullptr;
}

bool is_old_type(std::string_view word) {
    return find(old_types, "", word) != nullptr;
}

bool is_old_name(std::string_view directive, std::string_view name) {
    return find(old_names, directive, name) != nullptr;
}

void old_version_error(const Lexer& lexer, const Place& place, std::string_view found) {
    const Findings findings = examine(lexer);
    std::string changes;
    for (const Findings::Change& change : findings.changes) {
        if (!changes.empty()) changes += "; ";
        changes += fmt::format("line {}: {}", change.line, change.old->now);
    }
    const std::string_view version = findings.versions == v2   ? "pbrt-v2"
                                     : findings.versions == v3 ? "pbrt-v3"
                                                               : "pbrt-v2 or pbrt-v3";
    user_error_at(place,
                  "'{}' is {} syntax; expected a pbrt-v4 scene. What to change: {}. (`pbrt "
                  "--upgrade` of pbrt-v4 does most of it for a pbrt-v3 file.)",
                  shown(found), version, changes.empty() ? "see pbrt-v4's manual" : changes);
}

}  // namespace drude
