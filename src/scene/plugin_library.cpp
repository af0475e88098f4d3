// Plugins as files: where they are, whether they are whole, and what they say of themselves.
#include <dlfcn.h>
#include <elf.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <sstream>

#include "base/files.h"
#include "scene/plugin_surface.h"

namespace drude {

namespace fs = std::filesystem;

namespace {

bool is_plain_name(const std::string& name) {
    return !name.empty() && name[0] != '.' && name.size() < 200 &&
           std::all_of(name.begin(), name.end(), [](char c) {
               return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
                      c == '.' || c == '_' || c == '-';
           });
}

// The loader maps what the headers promise, and touching what a shortened file lacks would end the
// program: everything that is to be mapped has to be there.
bool is_whole_shared_object(const std::string& bytes) {
    Elf64_Ehdr header;
    if (bytes.size() < sizeof header) return false;
    std::memcpy(&header, bytes.data(), sizeof header);
    if (std::memcmp(header.e_ident, ELFMAG, SELFMAG) != 0 ||
        header.e_ident[EI_CLASS] != ELFCLASS64 || header.e_type != ET_DYN ||
        header.e_phentsize != sizeof(Elf64_Phdr)) {
        return false;
    }
    const auto holds = [&](uint64_t offset, uint64_t size) {
        return offset <= bytes.size() && size <= bytes.size() - offset;
    };
    if (!holds(header.e_phoff, uint64_t{header.e_phnum} * sizeof(Elf64_Phdr))) return false;
    bool is_dynamic = false;
    for (size_t i = 0; i < header.e_phnum; ++i) {
        Elf64_Phdr segment;
        std::memcpy(&segment, bytes.data() + header.e_phoff + i * sizeof segment, sizeof segment);
        if (segment.p_type == PT_LOAD && !holds(segment.p_offset, segment.p_filesz)) return false;
        is_dynamic = is_dynamic || segment.p_type == PT_DYNAMIC;
    }
    // The section table is the last thing that linkers write.
    return is_dynamic &&
           holds(header.e_shoff, uint64_t{header.e_shnum} * uint64_t{header.e_shentsize});
}

struct Extension {
    const char* name;
    bool is_present;
};

// The words of DRUDE_INSTRUCTION_SET.
std::vector<Extension> extensions() {
#ifdef __x86_64__
    // The builtin takes literals alone.
    return {{"sse4.2", __builtin_cpu_supports("sse4.2") != 0},
            {"avx", __builtin_cpu_supports("avx") != 0},
            {"avx2", __builtin_cpu_supports("avx2") != 0},
            {"fma", __builtin_cpu_supports("fma") != 0},
            {"bmi2", __builtin_cpu_supports("bmi2") != 0},
            {"fma4", __builtin_cpu_supports("fma4") != 0},
            {"xop", __builtin_cpu_supports("xop") != 0},
            {"avx512f", __builtin_cpu_supports("avx512f") != 0},
            {"avx512bw", __builtin_cpu_supports("avx512bw") != 0},
            {"avx512dq", __builtin_cpu_supports("avx512dq") != 0},
            {"avx512vl", __builtin_cpu_supports("avx512vl") != 0},
            {"avx512vbmi", __builtin_cpu_supports("avx512vbmi") != 0},
            {"avx512vnni", __builtin_cpu_supports("avx512vnni") != 0}};
#else
    return {};
#endif
}

void check_instruction_set(const char* set, const std::string& path, const Place& place) {
    const std::vector<Extension> known = extensions();
    std::vector<std::string> names;
    for (const Extension& e : known) names.emplace_back(e.name);
    std::istringstream words(set);
    for (std::string word; words >> word;) {
        const auto found = std::find_if(known.begin(), known.end(),
                                        [&](const Extension& e) { return word == e.name; });
        if (found == known.end()) {
            user_error_at(place,
                          "{}: its instruction set holds the word '{}'{}; expected what "
                          "DRUDE_INSTRUCTION_SET of render/plugin.h makes: {}",
                          path, shown(word), did_you_mean(word, names), fmt::join(names, ", "));
        }
        if (!found->is_present) {
            user_error_at(place,
                          "{}: is compiled for{}, and this processor has no {}; build it for this "
                          "machine, or without -march",
                          path, set, word);
        }
    }
}

}  // namespace

std::vector<std::string> plugin_folders() {
    std::vector<std::string> folders;
    const char* path = std::getenv("DRUDE_PLUGIN_PATH");
    std::istringstream fields(path == nullptr ? "" : path);
    for (std::string folder; std::getline(fields, folder, ':');) {
        if (!folder.empty()) folders.push_back(folder);
    }
    return folders;
}

std::string find_plugin(const std::string& name) {
    if (!is_plain_name(name)) return {};
    for (const std::string& folder : plugin_folders()) {
        for (const std::string& file : {name + ".so", "lib" + name + ".so"}) {
            std::error_code error;
            const fs::path path = fs::absolute(fs::path(folder) / file, error);
            if (!error && fs::is_regular_file(path, error)) return path.lexically_normal().string();
        }
    }
    return {};
}

std::vector<std::string> plugin_names() {
    std::vector<std::string> names;
    for (const std::string& folder : plugin_folders()) {
        std::error_code error;
        for (fs::directory_iterator entry(folder, error), end; !error && entry != end;
             entry.increment(error)) {
            std::string name = entry->path().stem().string();
            if (entry->path().extension() != ".so" || !is_plain_name(name)) continue;
            if (name.rfind("lib", 0) == 0 && name.size() > 3) name = name.substr(3);
            names.push_back(std::move(name));
        }
    }
    std::sort(names.begin(), names.end());
    names.erase(std::unique(names.begin(), names.end()), names.end());
    return names;
}

const DrudeSurfacePlugin& load_plugin(const std::string& path, const Place& place) {
    std::string bytes;
    try {
        bytes = read_file(path);
    } catch (const Error& error) {
        throw Error(error.cause(), place, error.message());
    }
    if (!is_whole_shared_object(bytes)) {
        user_error_at(place, "{}: is not a whole shared object of 64 bits; build it again", path);
    }
    // Never closed: surfaces point into it.
    void* library = dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL);
    if (library == nullptr) {
        const char* reason = dlerror();
        user_error_at(place, "{}: does not load: {}", path, reason ? reason : "no reason given");
    }
    // POSIX lets dlsym's pointer be a function's; C++ leaves it to the implementation.
    const auto query =
        reinterpret_cast<decltype(&drude_surface_plugin)>(dlsym(library, "drude_surface_plugin"));
    if (query == nullptr) {
        user_error_at(place,
                      "{}: does not export drude_surface_plugin(); expected a plugin as "
                      "render/plugin.h describes it (in C++ inside extern \"C\")",
                      path);
    }
    const DrudeSurfacePlugin* plugin = query();
    if (plugin == nullptr) {
        user_error_at(place, "{}: drude_surface_plugin() gave nothing; expected its table", path);
    }
    // Nothing else of it is read before these are known to be right.
    if (plugin->version != DRUDE_PLUGIN_VERSION) {
        user_error_at(place,
                      "{}: is built for version {} of render/plugin.h, and this program has "
                      "version {}; build it against the header that is installed with it",
                      path, plugin->version, DRUDE_PLUGIN_VERSION);
    }
    if (plugin->size != sizeof(DrudeSurfacePlugin)) {
        user_error_at(place,
                      "{}: its table has {} bytes; expected {}; build it against the header that "
                      "is installed with this program",
                      path, plugin->size, sizeof(DrudeSurfacePlugin));
    }
    const auto missing = [&](std::string_view what) {
        user_error_at(place, "{}: has no '{}' in its table; expected all of it", path, what);
    };
    if (plugin->instruction_set == nullptr) missing("instruction_set");
    check_instruction_set(plugin->instruction_set, path, place);
    if (plugin->description == nullptr) missing("description");
    if (plugin->parameters == nullptr) missing("parameters");
    if (plugin->create == nullptr) missing("create");
    if (plugin->destroy == nullptr) missing("destroy");
    if (plugin->evaluate == nullptr) missing("evaluate");
    if (plugin->sample == nullptr) missing("sample");
    if (plugin->pdf == nullptr) missing("pdf");
    return *plugin;
}

}  // namespace drude
