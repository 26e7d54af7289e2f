// SPDX-License-Identifier: BSD-3-Clause
#include "tools/plan/plan_command.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "modules/plan/plan_network.hpp"
#include "modules/plan/plan_reader.hpp"
#include "tools/output/json_document.hpp"
#include "tools/output/output_file.hpp"
#include "tools/output/svg.hpp"

namespace waitpoint::tools {
namespace {

/// The windows of an action with the first branches.
struct Row {
  const plan::Action* action;
  Duration earliest_start, latest_start, earliest_end, latest_end;
};

std::vector<Row> rows(const plan::TemporalPlan& plan) {
  const plan::Situation situation(plan);
  const plan::PlanNetwork network(plan, situation);
  const plan::Dispatcher dispatcher(network.network());
  std::vector<Row> rows;
  for (std::size_t i = 0; i < plan.actions.size(); ++i) {
    if (!situation.is_active(plan, i)) continue;
    const plan::PointId start = plan::start_of(i), end = plan::end_of(i);
    rows.push_back({&plan.actions[i], dispatcher.earliest(start), dispatcher.latest(start), dispatcher.earliest(end),
                    dispatcher.latest(end)});
  }
  return rows;
}

bool is_bounded(Duration duration) { return duration <= plan::bound_max; }

std::string window(Duration earliest, Duration latest) {
  return is_bounded(latest) ? fmt::format("{:.3f} to {:.3f}", earliest.seconds(), latest.seconds())
                            : fmt::format("from {:.3f}", earliest.seconds());
}

std::string plan_json(const plan::TemporalPlan& plan, const std::string& verdict) {
  using Json = nlohmann::ordered_json;
  Json json{{"plan", plan.name}, {"verdict", verdict}, {"actions", Json::array()}};
  for (const Row& row : rows(plan)) {
    Json action{{"name", row.action->name},
                {"contingent", row.action->contingent},
                {"earliest_start_s", row.earliest_start.seconds()}};
    if (is_bounded(row.latest_start)) action["latest_start_s"] = row.latest_start.seconds();
    action["earliest_end_s"] = row.earliest_end.seconds();
    if (is_bounded(row.latest_end)) action["latest_end_s"] = row.latest_end.seconds();
    json["actions"].push_back(std::move(action));
  }
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace

void declare(Command& command, PlanOptions& options) {
  command.description = "Prints the windows of a temporal plan's actions, if it is consistent (docs/laas-plans.md).";
  command.examples = {"scenarios/plans/guide.yaml --picture guide.svg"};
  OptionValue file{.file = OptionValue::File::read};
  file.take = [&options](const std::string&, const std::string& text) { options.file = text; };
  command.add("PLAN", std::move(file), "YAML file", {.is_required = true});
  command.section("Results");
  declare_picture(command, options.picture, "write a picture of the plan", "--svg");
  command.json(options.json);
}

std::string plan_picture(const plan::TemporalPlan& plan) {
  constexpr double left = 190, width = 620, row_height = 24, top = 30;
  const std::vector<Row> all = rows(plan);
  Duration last = std::chrono::seconds(1);
  for (const Row& row : all) last = std::max(last, is_bounded(row.latest_end) ? row.latest_end : row.earliest_end);
  const double bottom = top + row_height * static_cast<double>(all.size());
  Svg svg(left + width + 20, bottom + 30);
  const auto x = [&](Duration time) { return left + width * std::min(1.0, time.seconds() / last.seconds()); };
  const auto style = [](const char* colour) { return fmt::format("fill=\"{}\"", colour); };
  const std::string small = "font-family=\"sans-serif\" font-size=\"12\"";
  svg.text({10, 18}, plan.name, small + " font-weight=\"bold\"");
  constexpr int marks = 5;
  for (int i = 0; i <= marks; ++i) {
    const Duration time = last * i / marks;
    svg.line({x(time), top}, {x(time), bottom}, "stroke=\"#ccc\"");
    svg.text({x(time), bottom + 16}, fmt::format("{:.1f} s", time.seconds()), small + " text-anchor=\"middle\"");
  }
  for (std::size_t i = 0; i < all.size(); ++i) {
    const Row& row = all[i];
    const double y = top + row_height * static_cast<double>(i);
    const Duration end = is_bounded(row.latest_end) ? row.latest_end : last;
    const bool contingent = row.action->contingent;
    svg.text({10, y + 16}, row.action->name, small);
    svg.rectangle({x(row.earliest_start), y + 4}, x(end) - x(row.earliest_start), row_height - 8,
                  style(contingent ? "#f6d9b8" : "#c9dcf2"));
    svg.rectangle({x(row.earliest_start), y + 4},
                  std::max(1.0, x(row.earliest_start + row.action->least) - x(row.earliest_start)), row_height - 8,
                  style(contingent ? "#d9822b" : "#3a6ea5"));
  }
  return svg.finish();
}

int show_plan(const PlanOptions& options) {
  const plan::TemporalPlan plan = plan::read_plan(scenario::load_yaml(options.file));
  const std::string verdict = to_string(check(plan));
  std::string text =
      fmt::format("plan '{}': {}\n\n  {:<40} {:>22} {:>22}\n", plan.name, verdict, "action", "start in s", "end in s");
  for (const Row& row : rows(plan))
    text += fmt::format("  {:<40} {:>22} {:>22}\n", row.action->name + (row.action->contingent ? " (contingent)" : ""),
                        window(row.earliest_start, row.latest_start), window(row.earliest_end, row.latest_end));
  if (options.picture) {
    OutputFile picture(*options.picture);
    picture.write(plan_picture(plan));
    picture.commit();
  }
  write_text(text, options.json);
  return options.json ? end_with_json("plan", 0, plan_json(plan, verdict)) : 0;
}

}  // namespace waitpoint::tools
