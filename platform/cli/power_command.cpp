#include <fmt/format.h>

#include <ostream>

#include <cli/commands.h>
#include <cli/program.h>
#include <power/power_table.h>

namespace platform::cli {

int print_power_table(const PowerTableOptions& options, std::ostream& out) {
  const power::PowerTable table = power::PowerTable::load(options.table);
  if (options.markdown) {
    out << power::as_markdown(table);
    return done;
  }
  out << fmt::format("{:<22} {:>9} {:>9} {:>9}  {:<14} {}\n", "coefficient", "low", "nominal",
                     "high", "unit", "status");
  for (const power::Coefficient& entry : table.entries()) {
    out << fmt::format("{:<22} {:>9.6g} {:>9.6g} {:>9.6g}  {:<14} {}\n", entry.name,
                       entry.value.low, entry.value.nominal, entry.value.high, entry.unit,
                       entry.status);
  }
  out << fmt::format(
      "\nTable '{}'. 'markervp power --markdown' prints the sources. An own table, or a changed "
      "copy of\nthis one: 'markervp power FILE.json' checks it, '--set power.table=FILE.json' uses "
      "it.\n",
      table.name());
  return done;
}

}  // namespace platform::cli
