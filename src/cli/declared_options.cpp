#include "cli/declared_options.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "base/error.h"
#include "base/numbers.h"

namespace drude {

void refuse_options(const OptionSet& given, const std::vector<const char*>& options,
                    const std::string& why) {
    for (const char* option : options) {
        if (given.given(option)) user_error("found {}, which {}", option, why);
    }
}

namespace {

struct Names {
    std::string name, short_name;
};

Names split_spec(const std::string& spec) {
    const size_t comma = spec.find(',');
    Names names{spec, ""};
    if (comma != std::string::npos) names = {spec.substr(comma + 1), spec.substr(0, comma)};
    const bool good_name = names.name.size() > 2 && names.name.substr(0, 2) == "--" &&
                           names.name.find_first_of(", =") == std::string::npos;
    const bool good_short = names.short_name.empty() ||
                            (names.short_name.size() == 2 && names.short_name[0] == '-' &&
                             std::isalpha(static_cast<unsigned char>(names.short_name[1])) != 0);
    if (!good_name || !good_short) {
        throw std::logic_error("option '" + spec + "' is not '--name' or '-n,--name'");
    }
    return names;
}

}  // namespace

DeclaredOption& DeclaredOptions::add(DeclaredOption::Kind kind, const std::string& spec,
                                     const std::string& help) {
    DeclaredOption added;
    added.kind = kind;
    if (kind == DeclaredOption::Kind::word) {
        added.name = spec;
    } else {
        const Names names = split_spec(spec);
        added.name = names.name;
        added.short_name = names.short_name;
    }
    if (find(added.name) || (!added.short_name.empty() && find(added.short_name))) {
        throw std::logic_error("option '" + spec + "' is declared twice");
    }
    added.help = help;
    all_.push_back(std::move(added));
    return all_.back();
}

void DeclaredOptions::option(const std::string& spec, std::string& target,
                             const std::string& help) {
    DeclaredOption& added = add(DeclaredOption::Kind::value, spec, help);
    added.value_name = "VALUE";
    added.default_text = target;
    added.assign = [&target](const std::vector<std::string>& values) { target = values.back(); };
}

void DeclaredOptions::option(const std::string& spec, double& target, const std::string& help) {
    DeclaredOption& added = add(DeclaredOption::Kind::value, spec, help);
    added.value_name = "X";
    // Zero and NaN are how commands spell "not given".
    if (std::isfinite(target) && target != 0) added.default_text = format_double(target);
    added.assign = [&target, name = added.name](const std::vector<std::string>& values) {
        const std::optional<double> value = parse_double(values.back());
        if (!value || !std::isfinite(*value)) {
            user_error("{}: found '{}', expected a finite number", name, values.back());
        }
        target = *value;
    };
}

void DeclaredOptions::option(const std::string& spec, int& target, const std::string& help) {
    DeclaredOption& added = add(DeclaredOption::Kind::value, spec, help);
    added.value_name = "N";
    if (target != 0) added.default_text = fmt::format("{}", target);
    added.assign = [&target, name = added.name](const std::vector<std::string>& values) {
        const std::optional<long long> value = parse_integer(values.back());
        if (!value) user_error("{}: found '{}', expected a whole number", name, values.back());
        if (*value < std::numeric_limits<int>::min() || *value > std::numeric_limits<int>::max()) {
            user_error("{}: found '{}', expected a whole number from {} to {}", name, values.back(),
                       std::numeric_limits<int>::min(), std::numeric_limits<int>::max());
        }
        target = static_cast<int>(*value);
    };
}

void DeclaredOptions::option(const std::string& spec, uint64_t& target, const std::string& help) {
    DeclaredOption& added = add(DeclaredOption::Kind::value, spec, help);
    added.value_name = "N";
    if (target != 0) added.default_text = fmt::format("{}", target);
    added.assign = [&target, name = added.name](const std::vector<std::string>& values) {
        const std::optional<uint64_t> value = parse_unsigned(values.back());
        if (!value) {
            user_error("{}: found '{}', expected a whole number from 0 to {}", name, values.back(),
                       std::numeric_limits<uint64_t>::max());
        }
        target = *value;
    };
}

void DeclaredOptions::option(const std::string& spec, std::vector<std::string>& target,
                             const std::string& help) {
    DeclaredOption& added = add(DeclaredOption::Kind::value, spec, help);
    added.value_name = "VALUE";
    added.repeats = true;
    added.assign = [&target](const std::vector<std::string>& values) { target = values; };
}

void DeclaredOptions::flag(const std::string& spec, bool& target, const std::string& help) {
    DeclaredOption& added = add(DeclaredOption::Kind::flag, spec, help);
    added.assign = [&target](const std::vector<std::string>&) { target = true; };
}

void DeclaredOptions::choice(const std::string& spec, std::string& target,
                             const std::vector<std::string>& allowed, const std::string& help) {
    DeclaredOption& added = add(DeclaredOption::Kind::value, spec, help);
    added.value_name = fmt::format("{}", fmt::join(allowed, "|"));
    added.choices = allowed;
    added.default_text = target;
    added.assign = [&target, allowed, name = added.name](const std::vector<std::string>& values) {
        const std::string& value = values.back();
        if (std::find(allowed.begin(), allowed.end(), value) == allowed.end()) {
            user_error("{}: found '{}', expected one of {}{}", name, value,
                       fmt::join(allowed, ", "), did_you_mean(value, allowed));
        }
        target = value;
    };
}

void DeclaredOptions::positional(const std::string& name, std::string& target,
                                 const std::string& help, bool required) {
    DeclaredOption& added = add(DeclaredOption::Kind::word, name, help);
    added.at_least = required ? 1 : 0;
    added.default_text = target;
    added.assign = [&target](const std::vector<std::string>& values) { target = values.back(); };
}

void DeclaredOptions::positionals(const std::string& name, std::vector<std::string>& target,
                                  const std::string& help, int at_least) {
    DeclaredOption& added = add(DeclaredOption::Kind::word, name, help);
    added.at_least = static_cast<size_t>(std::max(0, at_least));
    added.repeats = true;
    added.assign = [&target](const std::vector<std::string>& values) { target = values; };
}

bool DeclaredOptions::given(const std::string& name) const {
    const DeclaredOption* option = find(name);
    if (!option) throw std::logic_error("option '" + name + "' was never declared");
    return option->given;
}

std::vector<std::string> DeclaredOptions::names() const {
    std::vector<std::string> names;
    for (const DeclaredOption& option : all_) {
        if (option.kind == DeclaredOption::Kind::word) continue;
        names.push_back(option.name);
        if (!option.short_name.empty()) names.push_back(option.short_name);
    }
    return names;
}

const DeclaredOption* DeclaredOptions::find(const std::string& name) const {
    for (const DeclaredOption& option : all_) {
        if (option.name == name || (!name.empty() && option.short_name == name)) return &option;
    }
    return nullptr;
}

void declare_command(const Command& command, DeclaredCommand& declared) {
    DeclaredOptions& options = declared.options;
    declared.run = command.declare(options, declared.common);
    options.flag("--json", declared.common.json,
                 "print one JSON document on standard output and nothing else there");
    options.flag("-q,--quiet", declared.common.quiet, "print no progress");
    options.option("--threads", declared.common.threads,
                   "threads to work with; 0, the default, takes all there are");
    options.flag("-h,--help", declared.help, "print this page");
}

}  // namespace drude
