#pragma once

#include <facts/result.h>
#include <facts/summary.h>
#include <result/members.h>
#include <result/verdict.h>

/// The parts of result.json, each declared in a file of its own with the figures in it.
namespace platform::result {

/// A run that is over.
struct WholeRun {
  const facts::RunFacts& facts;
  const facts::Summary& summary;
};

/// What is before the units: how the run went and ended.
const Members<facts::RunFacts>& end_members();
/// An element of `frames`.
const Members<facts::UnitReport>& unit_members();
/// What is behind the units: summary, verdict, and what the design costs.
const Members<WholeRun>& figure_members();

const Members<Verdict>& verdict_members();
const Members<facts::PowerReport>& power_members();
/// `power_w` of the summary.
const Members<facts::PowerReport>& power_summary_members();
const Members<facts::ResourceReport>& resource_members();
const Members<facts::TimingReport>& timing_members();
const Members<facts::ClockReport>& clock_members();

/// Places of watts and millijoules: sums of what is in the file hold to 1e-9.
constexpr int energy_places = 12;
constexpr int us_places = 6;  ///< 1 ps
constexpr int percent_places = 3;

}  // namespace platform::result
