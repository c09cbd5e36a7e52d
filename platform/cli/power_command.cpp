#include <fmt/format.h>

#include <ostream>

#include <cli/commands.h>
#include <cli/program.h>
#include <power/design_estimate.h>
#include <power/power_table.h>

namespace platform::cli {

namespace {

void print_watts(std::ostream& out, const std::string& name, const vp::Band& watts) {
  out << fmt::format("  {:<26}{:>8.3f}   {:.3f} to {:.3f}\n", name, watts.nominal, watts.low,
                     watts.high);
}

}  // namespace

int print_power_estimate(const PowerTableOptions& options, std::ostream& out) {
  const power::DesignFigures design = power::read_design_figures(options.design);
  const power::PowerEstimate estimate =
      power::estimate_power(design, power::PowerTable::load(options.table));
  out << fmt::format("{}, table '{}'           W   band\n", design.device.name(), options.table);
  for (const auto& [kind, watts] : estimate.ledger.by_group()) print_watts(out, kind, watts);
  out << "\nby module\n";
  for (const auto& [module, watts] : estimate.ledger.by_module()) print_watts(out, module, watts);
  out << "\nby rail\n";
  for (const auto& [rail, watts] : estimate.ledger.by_rail()) print_watts(out, rail, watts);
  out << '\n';
  print_watts(out, "total", estimate.ledger.total());
  out << fmt::format("  {:<26}{:>6.1f} C\n", "junction", estimate.junction_c);
  return done;
}

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
