// Is a document that the program wrote well-formed?
#pragma once

#include <algorithm>
#include <set>
#include <string>
#include <vector>

namespace drude {

// What is wrong with `xml` as a document of one element, or "": tags nest, attributes are quoted
// and not repeated, references are known, ids are unique.
inline std::string malformed(const std::string& xml) {
    std::vector<std::string> open;
    std::set<std::string> ids;
    size_t i = 0;
    int roots = 0;
    const auto here = [&] { return " near \"" + xml.substr(i, 40) + "\""; };
    const auto bad_text = [](const std::string& text) {
        for (size_t j = text.find('&'); j != std::string::npos; j = text.find('&', j + 1)) {
            const std::string name = text.substr(j, text.find(';', j) - j);
            if (name != "&amp" && name != "&lt" && name != "&gt" && name != "&quot" &&
                name != "&#39")
                return true;
        }
        return text.find('<') != std::string::npos;
    };
    while (i < xml.size()) {
        if (xml[i] != '<') {
            const size_t end = std::min(xml.find('<', i), xml.size());
            const std::string text = xml.substr(i, end - i);
            if (bad_text(text)) return "bad text" + here();
            if (open.empty() && text.find_first_not_of(" \n") != std::string::npos)
                return "text outside the root" + here();
            i = end;
            continue;
        }
        if (xml.compare(i, 2, "</") == 0) {
            const size_t end = xml.find('>', i);
            if (end == std::string::npos) return "open tag" + here();
            if (open.empty() || open.back() != xml.substr(i + 2, end - i - 2))
                return "wrong end tag" + here();
            open.pop_back();
            i = end + 1;
            continue;
        }
        if (open.empty() && ++roots > 1) return "second root" + here();
        size_t j = xml.find_first_of(" />", i + 1);
        if (j == std::string::npos) return "open tag" + here();
        open.push_back(xml.substr(i + 1, j - i - 1));
        std::set<std::string> names;
        while (xml[j] == ' ') {
            const size_t equals = xml.find("=\"", j);
            if (equals == std::string::npos) return "attribute without value" + here();
            const std::string name = xml.substr(j + 1, equals - j - 1);
            if (name.find_first_of(" <>/\"") != std::string::npos) return "bad attribute" + here();
            if (!names.insert(name).second) return "attribute twice" + here();
            const size_t end = xml.find('"', equals + 2);
            if (end == std::string::npos) return "open attribute" + here();
            const std::string value = xml.substr(equals + 2, end - equals - 2);
            if (bad_text(value)) return "bad attribute value" + here();
            if (name == "id" && !ids.insert(value).second) return "id twice" + here();
            j = end + 1;
        }
        if (xml.compare(j, 2, "/>") == 0) {
            open.pop_back();
            i = j + 2;
        } else if (xml[j] == '>') {
            i = j + 1;
        } else {
            return "bad tag" + here();
        }
    }
    return open.empty() ? (roots == 1 ? "" : "no root") : "never closed: " + open.back();
}

}  // namespace drude
