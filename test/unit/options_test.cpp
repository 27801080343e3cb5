// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Laws of the option table, the constants of the paper's profile, and refusals that name option,
// value and range.
#include "mvo/options.hpp"

#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <set>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace mvo {
namespace {

// The message of the std::invalid_argument that an action throws; empty if it throws none.
std::string refusal(const std::function<void()>& action) {
  try {
    action();
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

std::vector<std::string> values(Options options) {
  std::vector<std::string> list;
  for (const auto& row : optionTable(options)) list.push_back(row.name + "=" + row.get());
  return list;
}

bool isNumber(const OptionEntry& row) { return contains(row.range, "in ["); }

// The two ends of "in [low, high]".
std::pair<std::string, std::string> ends(const OptionEntry& row) {
  const auto open = row.range.find('[');
  const auto comma = row.range.find(", ", open);
  return {row.range.substr(open + 1, comma - open - 1),
          row.range.substr(comma + 2, row.range.find(']') - comma - 2)};
}

std::vector<std::string> words(const OptionEntry& row) {
  std::vector<std::string> list;
  std::size_t from = 0;
  for (std::size_t bar; (bar = row.range.find(" | ", from)) != std::string::npos; from = bar + 3)
    list.push_back(row.range.substr(from, bar - from));
  list.push_back(row.range.substr(from));
  return list;
}

void expectRefused(const OptionEntry& row, const std::string& value) {
  const std::string before = row.get();
  const std::string message = refusal([&] { row.set(value); });
  EXPECT_TRUE(contains(message, row.name)) << row.name << ": '" << message << "'";
  EXPECT_TRUE(contains(message, "'" + value + "'")) << message;
  if (isNumber(row)) {
    EXPECT_TRUE(contains(message, row.range)) << message;
  } else {
    for (const auto& word : words(row)) EXPECT_TRUE(contains(message, word)) << message;
  }
  EXPECT_EQ(row.get(), before);
}

TEST(OptionTable, NamesAreUniqueAndExplained) {
  Options options;
  std::set<std::string> names;
  for (const auto& row : optionTable(options)) {
    EXPECT_TRUE(names.insert(row.name).second) << row.name;
    EXPECT_EQ(row.name.find_first_not_of("abcdefghijklmnopqrstuvwxyz_."), std::string::npos)
        << row.name;
    EXPECT_FALSE(row.help.empty()) << row.name;
    EXPECT_FALSE(row.range.empty()) << row.name;
  }
  EXPECT_GT(names.size(), 30u);
}

TEST(OptionTable, SettingWhatIsThereChangesNothing) {
  for (Options options : {Options(), paperOptions()}) {
    const auto before = values(options);
    for (auto& row : optionTable(options)) row.set(row.get());
    EXPECT_EQ(values(options), before);
  }
}

TEST(OptionTable, EachRowSetsItsOwnFieldOnly) {
  Options defaults;
  const auto rows = optionTable(defaults);
  const auto before = values(defaults);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const auto candidates =
        isNumber(rows[i]) ? std::vector<std::string>{ends(rows[i]).first, ends(rows[i]).second}
                          : words(rows[i]);
    ASSERT_GE(candidates.size(), 2u) << rows[i].name;
    for (const auto& value : candidates) {
      Options options;
      setOption(options, rows[i].name, value);
      auto expected = before;
      expected[i] = rows[i].name + "=" + value;
      EXPECT_EQ(values(options), expected) << rows[i].name;
    }
  }
}

TEST(OptionTable, RefusesWhatIsOutOfRange) {
  Options options;
  for (const auto& row : optionTable(options)) {
    for (const char* value : {"", " ", "nan", "inf", "-inf", "true1", "1,5", "2x", "--"})
      expectRefused(row, value);
    if (!isNumber(row)) {
      expectRefused(row, "0.5");
      continue;
    }
    const auto [low, high] = ends(row);
    expectRefused(row, std::to_string(std::stod(low) - 1));
    expectRefused(row, std::to_string(std::stod(high) + 1));
    expectRefused(row, "1e300");
  }
}

TEST(OptionTable, RefusesFractionsOfWholeNumbers) {
  Options options;
  for (const char* name : {"window.frames", "graph.neighbors", "proposal.iterations", "seed"}) {
    const std::string message = refusal([&] { setOption(options, name, "7.5"); });
    EXPECT_TRUE(contains(message, name)) << message;
    EXPECT_TRUE(contains(message, "whole number")) << message;
  }
  setOption(options, "window.frames", "7");
  EXPECT_EQ(options.window.frames, 7);
}

TEST(Options, UnknownNamesAreRefused) {
  Options options;
  for (const char* name : {"", "window", "window.", "window.frame", "Window.frames", "frames"}) {
    const std::string message = refusal([&] { setOption(options, name, "5"); });
    EXPECT_TRUE(contains(message, "'" + std::string(name) + "'")) << message;
  }
}

TEST(Options, ChoicesGoByTheirWords) {
  Options options;
  setOption(options, "engine.solver", "coral");
  EXPECT_EQ(options.engine.solver, Solver::kCoral);
  setOption(options, "engine.solver", "alpha_expansion");
  EXPECT_EQ(options.engine.solver, Solver::kAlphaExpansion);
  setOption(options, "engine.engine", "sequential_ransac");
  EXPECT_EQ(options.engine.engine, Engine::kSequentialRansac);
  setOption(options, "proposal.ranking", "count");
  EXPECT_EQ(options.proposal.ranking, Ranking::kCount);
  setOption(options, "energy.residual", "image_distance");
  EXPECT_EQ(options.energy.residual, ResidualModel::kImageDistance);
  setOption(options, "bundle_adjustment.damping", "gauss_newton");
  EXPECT_EQ(options.bundle_adjustment.damping, DampingMethod::kGaussNewton);
}

TEST(Options, ProfilesAreValid) {
  EXPECT_NO_THROW(Options().validate());
  EXPECT_NO_THROW(paperOptions().validate());
  EXPECT_EQ(values(optionsOfProfile("default")), values(Options()));
  EXPECT_EQ(values(optionsOfProfile("paper")), values(paperOptions()));
  const std::string message = refusal([] { optionsOfProfile("papers"); });
  for (const char* part : {"'papers'", "default", "paper"}) EXPECT_TRUE(contains(message, part));
}

TEST(Options, PaperProfileHasThePapersConstants) {
  const Options paper = paperOptions();
  EXPECT_EQ(paper.window.frames, 48);
  EXPECT_EQ(paper.graph.neighbors, 5);
  EXPECT_EQ(paper.proposal.iterations, 1000);
  EXPECT_EQ(paper.proposal.threshold, 4);
  EXPECT_EQ(paper.proposal.ranking, Ranking::kCount);
  EXPECT_EQ(paper.proposal.confidence, 1);  // all 1000 iterations
  EXPECT_EQ(paper.energy.residual, ResidualModel::kImageDistance);
  EXPECT_FALSE(paper.energy.long_pairs);
  EXPECT_EQ(paper.energy.threshold, 4);
  EXPECT_EQ(paper.energy.smoothness, 1);
  EXPECT_EQ(paper.energy.label_cost, 1000);
  EXPECT_EQ(paper.energy.outlier_scale, 100);
  EXPECT_EQ(paper.energy.outlier_decay, 2);
  EXPECT_EQ(paper.engine.engine, Engine::kMultimotion);
  EXPECT_EQ(paper.engine.solver, Solver::kCoral);
  EXPECT_EQ(paper.engine.min_tracklets, 10);
  EXPECT_EQ(paper.engine.min_frames, 3);
  EXPECT_EQ(paper.bundle_adjustment.damping, DampingMethod::kGaussNewton);
}

TEST(Options, ValidateNamesTheOffender) {
  Options options;
  options.window.frames = 2;
  std::string message = refusal([&] { options.validate(); });
  for (const char* part : {"window.frames", "'2'", "[3, "})
    EXPECT_TRUE(contains(message, part)) << message;

  options = {};
  options.energy.smoothness = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(contains(refusal([&] { options.validate(); }), "energy.smoothness"));

  options = {};
  options.frontend.patch = 12;
  message = refusal([&] { options.validate(); });
  for (const char* part : {"frontend.patch", "'12'", "odd"})
    EXPECT_TRUE(contains(message, part)) << message;

  options = {};
  options.frontend.min_depth = 5;
  options.frontend.max_depth = 4;
  message = refusal([&] { options.validate(); });
  for (const char* part : {"frontend.min_depth", "'5'", "4"})
    EXPECT_TRUE(contains(message, part)) << message;
}

}  // namespace
}  // namespace mvo
