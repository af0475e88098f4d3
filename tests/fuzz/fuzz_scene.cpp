// Scenes that name no file: what stands in a file of its own has a target of its own.
//
// Bytes that are changed one by one seldom make another scene, so half of the changes are made of
// whole words: directives, names and parameters that the reader knows.
#include <algorithm>
#include <random>
#include <vector>

#include "check_scene.h"
#include "fuzz.h"
#include "scene/vocabulary.h"

extern "C" size_t LLVMFuzzerMutate(uint8_t* data, size_t size, size_t largest);

namespace drude {

namespace {

using Words = std::vector<std::string>;

void add(Words& words, std::initializer_list<const char*> more) {
    words.insert(words.end(), more.begin(), more.end());
}

Words vocabulary() {
    Words words;
    add(words, {"Identity",
                "Translate 1 0 0",
                "Scale 2 1 -1",
                "Rotate 30 0 0 1",
                "ActiveTransform",
                "LookAt 0 0 -4 0 0 0 0 1 0",
                "AttributeBegin",
                "AttributeEnd",
                "TransformBegin",
                "TransformEnd",
                "ObjectBegin \"o\"",
                "ObjectEnd",
                "ObjectInstance \"o\"",
                "ReverseOrientation",
                "WorldBegin",
                "CoordSysTransform \"camera\"",
                "Include",
                "Import",
                "NamedMaterial \"m\"",
                "[",
                "]",
                "#",
                "\"",
                "[ ]",
                "true",
                "false"});
    add(words, {"0",
                "1",
                "-1",
                "0.5",
                "3",
                "-0",
                "1e15",
                "1e-15",
                "1e38",
                "1e-40",
                "1e308",
                "1e-320",
                "nan",
                "-inf",
                "2147483647",
                "-2147483648",
                "4294967296",
                "[ 1 2 3 ]",
                "[ 0 1 2 ]",
                "[ 400 1 700 2 ]",
                "[ 0 0 0 1 0 0 0 1 0 ]"});
    const char* const kinds[] = {"Camera",      "Film",       "Sampler",         "PixelFilter",
                                 "Integrator",  "Shape",      "Accelerator",     "Material",
                                 "LightSource", "ColorSpace", "AreaLightSource", "Option"};
    for (const std::string kind : kinds) {
        for (const std::string& name : known_names(kind)) {
            words.push_back(kind + " \"" + name + "\"");
        }
    }
    for (const std::string& name : known_names("Texture")) {
        for (const char* type : {"float", "spectrum"}) {
            words.push_back(std::string("Texture \"t\" \"") + type + "\" \"" + name + "\"");
        }
    }
    for (const std::string& name : known_names("Material")) {
        words.push_back("MakeNamedMaterial \"m\" \"string type\" \"" + name + "\"");
    }
    add(words, {"\"t\"", "\"m\"", "\"o\"", "\"Cu\"", "\"metal-Au-eta\"", "\"metal-Au-k\"",
                "\"glass-BK7\"", "\"stdillum-A\"", "\"rayleigh\"", "\"planar\"", "\"gaussian\"",
                "\"smith\"", "\"v-groove\"", "\"light\"", "\"shape\"", "\"material\""});
    const char* const types[] = {"bool",   "integer", "float", "point2",    "point3",   "vector3",
                                 "normal", "string",  "rgb",   "blackbody", "spectrum", "texture"};
    for (const std::string kind : kinds) {
        for (const std::string& name : known_parameters(kind, "")) {
            for (const std::string type : types) words.push_back("\"" + type + " " + name + "\"");
        }
    }
    for (const std::string& name : known_parameters("Texture", "")) {
        for (const std::string type : types) words.push_back("\"" + type + " " + name + "\"");
    }
    return words;
}

// Where words begin and end, by white space alone.
std::vector<std::pair<size_t, size_t>> split(const std::string& text) {
    std::vector<std::pair<size_t, size_t>> spans;
    size_t i = 0;
    while (i < text.size()) {
        i = std::min(text.find_first_not_of(" \n\t\r", i), text.size());
        const size_t begin = i;
        i = std::min(text.find_first_of(" \n\t\r", i), text.size());
        if (i > begin) spans.emplace_back(begin, i);
    }
    return spans;
}

std::string change_a_word(std::string text, std::minstd_rand& random) {
    static const Words words = vocabulary();
    const auto spans = split(text);
    const std::string& word = words[random() % words.size()];
    if (spans.empty()) return word;
    const auto [begin, end] = spans[random() % spans.size()];
    switch (random() % 4) {
        case 0:
            return text.replace(begin, end - begin, word);
        case 1:
            return text.insert(begin, word + " ");
        case 2:
            return text.erase(begin, end - begin);
        default: {
            // Some words of the text once more.
            const auto [from, to] = spans[random() % spans.size()];
            const size_t length = std::min(to - from + random() % 60, text.size() - from);
            return text.insert(begin, text.substr(from, length) + " ");
        }
    }
}

}  // namespace

}  // namespace drude

extern "C" size_t LLVMFuzzerCustomMutator(uint8_t* data, size_t size, size_t largest,
                                          unsigned seed) {
    std::minstd_rand random(seed);
    if (random() % 2 == 0) return LLVMFuzzerMutate(data, size, largest);
    std::string text(reinterpret_cast<const char*>(data), size);
    for (auto times = random() % 4 + 1; times > 0; --times) {
        text = drude::change_a_word(std::move(text), random);
    }
    text.resize(std::min(text.size(), largest));
    std::copy(text.begin(), text.end(), data);
    return text.size();
}

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    return drude::fuzz_one(data, size, [](const std::string& text) {
        drude::check_scene(drude::parse_scene(text, "nowhere/fuzz.pbrt"));
    });
}
