#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <ostream>

#include <cli/commands.h>
#include <cli/program.h>
#include <designs/designs.h>
#include <vp/text.h>

namespace platform::cli {

int list_designs(const DesignsOptions& options, std::ostream& out) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  std::string text = fmt::format("{:<12} {:<20} {}\n", "design", "PS programs", "what");
  for (const DesignInfo* design : builtin_designs()) {
    list.push_back({{"name", design->name},
                    {"description", design->description},
                    {"programs", design->programs}});
    text += fmt::format("{:<12} {:<20} {}\n", design->name, vp::join(design->programs, ", "),
                        design->description);
  }
  if (options.json) {
    out << list.dump(2) << "\n";
  } else {
    out << text << "\nThe first is the usual one; 'markervp run --design NAME' takes another.\n";
  }
  return done;
}

}  // namespace platform::cli
