#include <algorithm>
#include <cctype>
#include <filesystem>
#include <ostream>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <cli/commands.h>
#include <cli/options.h>
#include <cli/program.h>
#include <cli/trace_options.h>
#include <trace/failure_page.h>
#include <trace/tools.h>
#include <vp/file.h>
#include <vp/unit.h>

namespace platform::cli {

namespace {

/// How many checks ended how.
struct CheckCounts {
  std::size_t passed = 0, failed = 0, not_exercised = 0, skipped = 0;
};

CheckCounts print_checks(const std::vector<trace::CheckResult>& results, std::ostream& out) {
  CheckCounts counts;
  for (const trace::CheckResult& result : results) {
    const trace::Check& check = *result.check;
    if (result.skipped) {
      ++counts.skipped;
      out << "SKIP " << check.name << ": " << result.missing << "\n";
    } else if (!result.exercised()) {
      ++counts.not_exercised;
      out << "NOT EXERCISED " << check.name << ": " << check.text << "\n";
    } else if (result.failures == 0) {
      ++counts.passed;
      out << "PASS " << check.name << " (" << result.occasions << " looked at)\n";
    } else {
      ++counts.failed;
      out << "FAIL " << check.name << " at " << vp::format_time(result.first_ps) << ": "
          << check.text << " (" << result.detail
          << (result.failures > 1 ? "; " + std::to_string(result.failures) + " times" : "")
          << ")\n";
    }
  }
  out << counts.passed << " passed, " << counts.failed << " failed";
  if (counts.not_exercised > 0) out << ", " << counts.not_exercised << " not exercised";
  if (counts.skipped > 0) out << ", " << counts.skipped << " skipped";
  out << "\n";
  return counts;
}

/// Names for the pages of checks: no two are the same, whatever the checks are called.
class PageNames {
 public:
  /// `first`: of the first failure.
  explicit PageNames(std::filesystem::path first) : first_(std::move(first)) {
    // Surfer's file lies beside each page, and has this extension.
    if (first_.extension() == ".sucl") first_.replace_extension(".gtkw");
  }
  std::filesystem::path next(const std::string& check) {
    if (used_.empty()) {
      used_.insert("");
      return first_;
    }
    std::string plain = check;
    for (char& c : plain) c = std::isalnum(static_cast<unsigned char>(c)) != 0 ? c : '_';
    std::string name = plain;
    for (unsigned n = 2; !used_.insert(name).second; ++n) name = plain + "_" + std::to_string(n);
    return named(name);
  }
  std::filesystem::path named(const std::string& part) const {
    std::filesystem::path page = first_;
    return page.replace_filename(first_.stem().string() + "." + part + first_.extension().string());
  }

 private:
  std::filesystem::path first_;
  std::set<std::string> used_;
};

/// Pages for GTKWave, Surfer and VaporView around each failure. The first one in time has the name
/// that the user gave; the others have theirs from their checks.
void write_pages(const TraceCommandOptions& options, const trace::TraceFile& file,
                 std::vector<const trace::CheckResult*> failed, std::ostream& out) {
  std::stable_sort(failed.begin(), failed.end(),
                   [](const auto* a, const auto* b) { return a->first_ps < b->first_ps; });
  PageNames names(options.output.value_or(options.file + ".failed.gtkw"));
  for (const trace::CheckResult* result : failed) {
    const std::filesystem::path page = names.next(result->check->name);
    const trace::SaveFile save = trace::failure_page(file, *result);
    vp::write_file(page.string(), trace::save_file_text(save));
    const std::string commands = std::filesystem::path(page).replace_extension(".sucl").string();
    vp::write_file(commands, trace::surfer_commands(save));
    vp::write_file(std::filesystem::path(page).replace_extension(".vaporview.json").string(),
                   trace::vaporview_settings(save));
    if (result != failed.front()) continue;
    out << "look at it: gtkwave " << options.file << " " << page.string() << ", or surfer "
        << options.file << " --command-file " << commands << "\n";
  }
  if (failed.size() > 1)
    out << "the others have pages of their own: " << names.named("CHECK").string() << "\n";
}

}  // namespace

int check_trace(const TraceCommandOptions& options, std::ostream& out, std::ostream& err) {
  const auto checks = trace::read_checks(options.checks);
  trace::TraceFile file = opened(options);
  const auto results = trace::run_checks(file, checks, options.skip_missing);
  const CheckCounts counts = print_checks(results, out);
  warn_of(file, err);
  if (counts.failed > 0) {
    std::vector<const trace::CheckResult*> failed;
    for (const trace::CheckResult& result : results) {
      if (result.failures > 0) failed.push_back(&result);
    }
    write_pages(options, file, std::move(failed), out);
    return run_failed;
  }
  const bool all_exercised = counts.not_exercised + counts.skipped == 0;
  return options.require_exercised && !all_exercised ? run_failed : done;
}

}  // namespace platform::cli
