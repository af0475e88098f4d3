#include "regress/junit.h"

#include <iterator>

#include "report/markup.h"

namespace drude {

std::string junit_xml(const RegressResult& run) {
    const size_t errors = run.count(CaseStatus::error), skipped = run.count(CaseStatus::skipped);
    std::string xml = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n";
    const auto out = std::back_inserter(xml);
    const std::string counts =
        fmt::format("tests=\"{}\" failures=\"{}\" errors=\"{}\" skipped=\"{}\" time=\"{:.3f}\"",
                    run.cases.size(), run.failed() - errors, errors, skipped, run.seconds);
    fmt::format_to(out, "<testsuites name=\"drude regress\" {}>\n", counts);
    fmt::format_to(out, "  <testsuite name=\"references\" {}>\n", counts);
    for (const CaseResult& result : run.cases) {
        fmt::format_to(out, "    <testcase classname=\"references\" name=\"{}\" time=\"{:.3f}\"",
                       escape_markup(result.declared.name), result.seconds);
        const std::string message = escape_markup(result.message);
        switch (result.status) {
            case CaseStatus::passed:
                xml += "/>\n";
                continue;
            case CaseStatus::skipped:
                xml += ">\n      <skipped/>\n";
                break;
            case CaseStatus::error:
            case CaseStatus::failed:
            case CaseStatus::weak:
            case CaseStatus::missing: {
                const char* element = result.status == CaseStatus::error ? "error" : "failure";
                fmt::format_to(
                    out, ">\n      <{0} type=\"{1}\" message=\"{2}\">{3}\n{4}\n{5}</{0}>\n",
                    element, status_word(result.status), message,
                    escape_markup(result.render_command), escape_markup(result.compare_command),
                    escape_markup(result.update_command));
                break;
            }
        }
        xml += "    </testcase>\n";
    }
    return xml + "  </testsuite>\n</testsuites>\n";
}

}  // namespace drude
