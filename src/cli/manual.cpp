#include "cli/manual.h"

#include "base/error.h"
#include "cli/declared_options.h"
#include "cli/help.h"

namespace drude {

namespace {

// One line of text as roff reads it: backslashes and hyphens literally, and no leading character
// that would make the line a request.
std::string roff(std::string_view line) {
    std::string escaped;
    if (!line.empty() && (line[0] == '.' || line[0] == '\'')) escaped = "\\&";
    for (const char c : line) {
        if (c == '\\') {
            escaped += "\\e";
        } else if (c == '-') {
            escaped += "\\-";
        } else if (c == '\'') {
            escaped += "\\(aq";
        } else if (c == '^') {
            escaped += "\\(ha";
        } else if (c == '~') {
            escaped += "\\(ti";
        } else {
            escaped += c;
        }
    }
    return escaped;
}

template <class Function>
void for_each_line(std::string_view text, const Function& function) {
    for (size_t begin = 0; begin < text.size();) {
        const size_t end = std::min(text.find('\n', begin), text.size());
        function(text.substr(begin, end - begin));
        begin = end + 1;
    }
}

// Lines that begin with a blank stand as they are, the rest is filled.
void append_paragraphs(std::string& page, std::string_view text) {
    bool verbatim = false;
    for_each_line(text, [&](std::string_view line) {
        const bool blank_first = !line.empty() && line[0] == ' ';
        if (blank_first != verbatim) page += blank_first ? ".nf\n" : ".fi\n";
        verbatim = blank_first;
        page += line.empty() ? ".PP" : roff(line);
        page += '\n';
    });
    if (verbatim) page += ".fi\n";
}

void append_command(std::string& page, const Command& command) {
    DeclaredCommand declared;
    declare_command(command, declared);
    page += fmt::format(".SS \"drude {}{}\"\n", roff(command.name),
                        roff(usage_words(declared.options)));
    append_paragraphs(page, command.summary);
    page += ".PP\n";
    append_paragraphs(page, command.description);
    for (const DeclaredOption& option : declared.options.all()) {
        page += fmt::format(".TP\n\\fB{}\\fR\n", roff(option_label(option)));
        append_paragraphs(page, option_text(option));
    }
    if (command.example.empty()) return;
    page += ".PP\nExample:\n.PP\n.RS 4\n.nf\n";
    for_each_line(command.example, [&](std::string_view line) { page += roff(line) + '\n'; });
    page += ".fi\n.RE\n";
}

}  // namespace

std::string manual_page(const std::vector<Command>& commands) {
    std::string page = fmt::format(
        ".TH DRUDE 1 \"\" \"drude {}\" \"User Commands\"\n"
        ".SH NAME\n"
        "drude \\- measure, fit, render and compare the polarising reflectance of metals\n"
        ".SH SYNOPSIS\n"
        "\\fBdrude\\fR \\fICOMMAND\\fR [\\fIWORD\\fR...] [\\fIOPTION\\fR...]\n"
        ".SH DESCRIPTION\n"
        "Results go to standard output, everything else to standard error. With \\fB\\-\\-json\\fR "
        "there is one JSON document on standard output and nothing else. Angles are in degrees, "
        "wavelengths and thicknesses in nanometres. Every output file is written under a temporary "
        "name and renamed when it is complete.\n"
        ".SH COMMANDS\n",
        DRUDE_VERSION);
    for (const Command& command : commands) append_command(page, command);
    page += ".SH \"EXIT STATUS\"\n";
    for (const auto& [status, meaning] : exit_statuses()) {
        page += fmt::format(".TP\n\\fB{}\\fR\n{}\n", status, roff(meaning));
    }
    page +=
        ".SH ENVIRONMENT\n"
        ".TP\n\\fBDRUDE_DEBUG\\fR\n"
        "Where set, an internal error tells what the program knows about it.\n"
        ".TP\n\\fBDRUDE_PLUGIN_PATH\\fR\n"
        "Folders, separated by colons, in which a scene's materials of unknown name are looked for "
        "as plugins, NAME.so.\n"
        ".TP\n\\fBDRUDE_MODULE_PATH\\fR\n"
        "Folders, separated by colons, in which the program's own modules (pictures through "
        "OpenImageIO, processes through Open MPI) are looked for before its own.\n"
        ".TP\n\\fBNO_COLOR\\fR\n"
        "Respected: nothing is printed in colour, with or without it.\n";
    return page;
}

}  // namespace drude
