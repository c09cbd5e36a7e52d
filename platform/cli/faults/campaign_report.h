#pragma once

#include <string>
#include <vector>

#include <cli/faults/campaign.h>
#include <nlohmann/json.hpp>

// What came of a campaign, as the console, files and the page show it.
namespace platform::cli {

/// Counts of outcomes by class and by module, for the console.
std::string campaign_tables(const Campaign& campaign);

/// The first fault of each outcome that a user wants to look into, with the command that has it
/// again.
std::string fearful_examples(const CampaignFile& file, const std::vector<Shot>& shots);

/// A line a fault; `fault` is what `--set inject=` takes in brackets.
std::string shots_csv(const std::vector<Shot>& shots);

/// Counts and 95 % intervals: all, by class, by module, by bit where a fault has one.
nlohmann::ordered_json campaign_json(const CampaignFile& file, const Campaign& campaign);

/// The same as a page, with the faults that did something. False if the program was built without
/// pages. Throws vp::OutputError.
bool write_campaign_page(const std::string& path, const CampaignFile& file,
                         const Campaign& campaign);

}  // namespace platform::cli
