#include "mdat/campaign/folder.hpp"

#include <algorithm>
#include <charconv>
#include <cstdio>
#include <fstream>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <sstream>

#include "mdat/campaign/case_counts.hpp"
#include "mdat/campaign/case_table.hpp"
#include "mdat/campaign/chunk_file.hpp"
#include "mdat/campaign/conclusion.hpp"
#include "mdat/campaign/figures.hpp"
#include "mdat/campaign/flight.hpp"
#include "mdat/campaign/kept_mission.hpp"
#include "mdat/campaign/report.hpp"
#include "mdat/campaign/results_h5.hpp"
#include "mdat/campaign/summary_files.hpp"
#include "mdat/campaign/summary_text.hpp"
#include "mdat/common/cpu_clock.hpp"
#include "mdat/common/errors.hpp"
#include "mdat/common/output.hpp"
#include "mdat/common/text.hpp"
#include "mdat/common/version.hpp"
#include "mdat/source/sha256.hpp"

namespace lasso::mdat {
namespace {

namespace fs = std::filesystem;

constexpr char kCaseTable[] = "cases.csv", kChunks[] = "chunks", kMission[] = "mission", kTimes[] = ".times";
constexpr double kNoFigure = std::numeric_limits<double>::quiet_NaN();

// Done in a process of its own: a compilation starts threads, and this process will fork.
std::string digest_of_image(const MissionInput& input, const std::string& campaign, bool cached) {
  Worker worker(
      [&]() -> Fly {
        const CompiledMission mission = compile_mission(MissionInput(input), ModelCache::of_user_if(cached));
        const std::string digest = image_sha256(mission, campaign_of(mission.source, campaign));
        return [digest](std::uint32_t) { return std::string(digest); };
      },
      [] {});
  for (;;) {
    const Worker::Message message = worker.receive();
    if (message.kind == Worker::Kind::kBadInput) throw InputError(message.text);
    if (message.kind == Worker::Kind::kError) throw RunError(message.text);
    if (message.kind == Worker::Kind::kDead) throw RunError("the process that compiles the mission has died: it may be short of memory");
    if (message.kind == Worker::Kind::kFields) return message.text;
    worker.give(0);
  }
}

// What the plan keeps of a case. One that an earlier mdat expanded keeps less.
std::string record_fields(const CampaignPlan& plan, const CaseResult& result) {
  std::string fields = "ok";
  for (const Figure& figure : case_figures()) {
    const bool kept = std::find(plan.figures.begin(), plan.figures.end(), figure.name) != plan.figures.end();
    if (kept) fields += "," + cell_text(figure.of(result));
  }
  if (plan.counts == count_names()) {
    for (const std::string& cell : count_cells(counts_of(result))) fields += "," + cell;
  }
  return fields;
}

// The values of any case: forward in the table where possible.
class CaseReader {
 public:
  explicit CaseReader(fs::path file) : file_(std::move(file)) { open(); }
  const std::vector<std::string>& columns() const { return table_->columns(); }
  CaseValues at(std::uint32_t number) {
    if (number < table_->case_number()) open();
    return table_->at(number);
  }

 private:
  void open() { table_ = std::make_unique<CaseTable>(file_); }
  fs::path file_;
  std::unique_ptr<CaseTable> table_;
};

// Processor time of cases, apart from their records: it is never the same twice. One file a runner, which its workers append lines to.
class TimesFile {
 public:
  explicit TimesFile(const fs::path& file) : out_(file, std::ios::app) {}
  void note(std::uint32_t number, double cpu_s) { out_ << format("%u,%.6f\n", number, cpu_s) << std::flush; }

 private:
  std::ofstream out_;
};

// All that a worker has while it flies.
struct CaseFlyer {
  CaseFlyer(const CampaignFolder& folder, const std::string& runner)
      : mission(compile_mission(MissionInput(folder.input), ModelCache::of_user_if(folder.cached))),
        cases(folder.path / kCaseTable),
        flight(mission, campaign_of(mission.source, folder.plan.campaign), cases.columns()),
        times(folder.path / kChunks / (runner + kTimes)),
        plan(folder.plan) {
    check_image(folder.plan, mission);
  }

  std::string fly(std::uint32_t number) {
    const double begin_us = process_cpu_us();  // a flight has two threads
    const CaseValues values = cases.at(number);
    std::string fields = record_fields(plan, flight.fly(values.seed, values.numbers));
    times.note(number, 1e-6 * (process_cpu_us() - begin_us));
    return fields;
  }

  CompiledMission mission;
  CaseReader cases;
  CampaignFlight flight;
  TimesFile times;
  const CampaignPlan& plan;
};

std::vector<double> figures_of(std::string_view cells, std::size_t count) {
  std::vector<double> figures;
  while (figures.size() < count) {
    cells.remove_prefix(cells.empty() ? 0 : 1);  // the comma before it
    const std::string_view cell = cells.substr(0, cells.find(','));
    double value = kNoFigure;
    std::from_chars(cell.data(), cell.data() + cell.size(), value);
    figures.push_back(value);
    cells.remove_prefix(cell.size());
  }
  return figures;
}

// `count`: of the campaign's figures.
CaseRow row_of(std::uint32_t number, std::string_view fields, std::size_t count, std::vector<double> drawn) {
  CaseRow row;
  row.number = number;
  row.drawn = std::move(drawn);
  row.status = is_failed(fields) ? std::string(fields) : std::string(fields.substr(0, fields.find(',')));
  row.figures = is_failed(fields) ? std::vector<double>(count, kNoFigure) : figures_of(fields.substr(row.status.size()), count);
  return row;
}

// Cells of a record behind the first `count`, as many as there are.
std::vector<std::string_view> cells_behind(std::string_view fields, std::size_t count) {
  std::vector<std::string_view> cells;
  for (std::size_t i = 0;; ++i) {
    const std::size_t comma = fields.find(',');
    if (i >= count) cells.push_back(fields.substr(0, comma));
    if (comma == std::string_view::npos) return cells;
    fields.remove_prefix(comma + 1);
  }
}

// Of the cases that are in the table, all together; their records are read once more, as counts of each would fill the memory.
std::optional<CaseCounts> counts_of_rows(const CampaignFolder& folder, const Records& records, const ResultTable& table) {
  if (folder.plan.counts != count_names()) return std::nullopt;
  CaseCounts sum;
  for (const CaseRow& row : table.rows) {
    if (!row.has_run()) continue;
    const std::string_view fields = records.of(row.number).value_or("");
    const std::optional<CaseCounts> counts = counts_of_cells(cells_behind(fields, 1 + table.figures.size()));
    if (!counts)
      throw InputError(folder.path.string() + ": case " + std::to_string(row.number) +
                       ": its record does not end with its counts; use the mdat that flew it (" + folder.plan.version + ", commit " +
                       folder.plan.commit + ")");
    sum.add(*counts);
  }
  return sum;
}

std::vector<std::string> figure_names() {
  std::vector<std::string> names;
  for (const Figure& figure : case_figures()) names.emplace_back(figure.name);
  return names;
}

// Asks the stopping rule as cases come, in whatever order: those whose predecessors are not there yet wait.
class Watch {
 public:
  Watch(const CampaignSource& campaign, const std::vector<std::string>& figures)
      : has_rule_(campaign.look_every > 0), figures_(figures.size()), rule_(campaign, {figures, {}, {}}) {}

  bool wants_more(std::uint32_t number, const std::string& fields) {
    if (!has_rule_) return true;
    waiting_.emplace(number, row_of(number, fields, figures_, {}));
    for (auto next = waiting_.find(next_); next != waiting_.end() && !has_ended_; next = waiting_.find(++next_)) {
      has_ended_ = rule_.ends_with(next->second);
      waiting_.erase(next);
    }
    return !has_ended_;
  }

 private:
  bool has_rule_, has_ended_ = false;
  std::size_t figures_;
  StoppingRule rule_;
  std::map<std::uint32_t, CaseRow> waiting_;
  std::uint32_t next_ = 0;
};

// The rule's limits hold for cases in the order of their numbers: those behind a missing one are left out.
void cut_at_first_missing(ResultTable& table) {
  std::uint32_t count = 0;
  while (count < table.rows.size() && table.rows[count].number == count) ++count;
  table.rows.resize(count);
}

std::string times_csv(const fs::path& folder, const ResultTable& table) {
  std::map<std::uint32_t, std::string> times;
  std::error_code none_yet;  // no case has been flown
  for (const auto& entry : fs::directory_iterator(folder / kChunks, none_yet)) {
    if (entry.path().extension() != kTimes) continue;
    std::ifstream in(entry.path());
    for (std::string line; std::getline(in, line);) {
      const std::size_t comma = line.find(',');
      std::uint32_t number = 0;
      if (comma == std::string::npos || std::from_chars(line.data(), line.data() + comma, number).ec != std::errc{}) continue;
      times[number] = line.substr(comma + 1);
    }
  }
  std::string text = "case,cpu_s\n";
  for (const CaseRow& row : table.rows) {
    const auto time = times.find(row.number);
    text += std::to_string(row.number) + "," + (time == times.end() ? "" : time->second) + "\n";
  }
  return text;
}

// Without what it takes long to know.
CampaignPlan plan_of_mission(const MissionSource& mission, const CampaignSource& campaign, const KeptMission& kept) {
  CampaignPlan plan;
  plan.mission = kept.mission;
  plan.files = kept.digests();
  plan.campaign = campaign.name;
  plan.settings = mission.settings;
  plan.figures = figure_names();
  plan.counts = count_names();
  plan.cases = campaign.cases;
  plan.look_every = campaign.look_every;
  plan.version = kVersion;
  plan.program_sha256 = program_sha256();
  return plan;
}

void refuse_to_remove_under_a_runner(const fs::path& folder) {
  for (const fs::path& file : chunk_files(folder)) {
    if (in_flight(file)) throw InputError(file.string() + ": another process flies this chunk: wait for it or stop it, then remove it");
  }
}

std::vector<fs::path> campaign_files(const fs::path& folder) {
  std::vector<fs::path> files;
  for (const char* name : {"plan.json", "cases.csv", "results.csv", "results.h5", "times.csv", "summary.json", "junit.xml", "report.html"})
    files.push_back(folder / name);
  return files;
}

// Removes what mdat has written there, and nothing else.
void remove_campaign(const fs::path& folder) {
  if (!has_plan(folder)) return;
  for (const fs::path& file : campaign_files(folder)) fs::remove(file);
  fs::remove_all(folder / kChunks);
}

// A campaign keeps its mission under that name: what is there without one is somebody's own.
void refuse_to_take_a_folder(const fs::path& folder) {
  if (has_plan(folder) || !fs::exists(folder / kMission)) return;
  throw InputError((folder / kMission).string() +
                   ": is there, and no campaign beside it; its copy of the mission would take that name: --out DIR");
}

}  // namespace

void expand_campaign(const MissionInput& input, const std::string& campaign, bool cached, const std::string& commit, const fs::path& folder,
                     bool replace) {
  if (replace) refuse_to_remove_under_a_runner(folder);
  if (!replace) refuse_to_replace(campaign_files(folder), "--force replaces it, --out DIR keeps it");
  refuse_to_take_a_folder(folder);
  const CampaignSource& source = campaign_of(input.source, campaign);
  OutputFolder out(folder);
  const KeptMission kept = kept_mission(input.source);
  CampaignPlan plan = plan_of_mission(input.source, source, kept);
  plan.image_sha256 = digest_of_image(input, campaign, cached);
  plan.commit = commit;
  std::ostringstream cases;
  write_cases(CaseDraws(source), source.cases, cases);
  const std::string text = std::move(cases).str();
  plan.cases_sha256 = sha256_of(text);
  out.write(kCaseTable, text);
  out.write("plan.json", plan_json(plan, source));
  keep_mission(kept, folder);  // before the rest goes: the mission may be the copy of the campaign that is replaced
  if (replace) remove_campaign(folder);
  out.commit();
}

CampaignFolder open_campaign(const fs::path& folder, bool cached) {
  LoadedPlan loaded = load_plan(folder);
  CampaignFolder result{folder, loaded.plan, loaded.digest, load_planned(folder, loaded.plan), cached};
  static_cast<void>(campaign_of(result.input.source, loaded.plan.campaign));
  return result;
}

EngineResult fly_campaign(const CampaignFolder& folder, EngineOptions options) {
  check_program(folder.plan);
  options.folder = folder.path;
  options.plan_digest = folder.digest;
  options.cases = folder.plan.cases;
  const std::string runner = chunk_name(options.chunk);
  Watch watch(folder.campaign(), folder.plan.figures);
  const bool whole = options.chunk.of == 1;
  return fly_cases(
      options,
      [&]() -> Fly {
        const auto flyer = std::make_shared<CaseFlyer>(folder, runner);
        return [flyer](std::uint32_t number) { return flyer->fly(number); };
      },
      [&](std::uint32_t number, const std::string& fields) { return !whole || watch.wants_more(number, fields); });
}

ResultTable merged(const CampaignFolder& folder, bool partial) {
  const Records records(folder.path, folder.digest, folder.plan.cases);
  CaseTable cases(folder.path / kCaseTable);
  ResultTable table{folder.plan.figures, cases.columns(), {}};
  for (std::uint32_t number = 0; number < folder.plan.cases; ++number) {
    std::vector<double> drawn = cases.at(number).numbers;
    if (const auto fields = records.of(number)) table.rows.push_back(row_of(number, *fields, table.figures.size(), std::move(drawn)));
  }
  if (const auto stop = stop_at(folder.campaign(), table)) {
    table.rows.resize(*stop);
  } else if (records.missing() > 0 && !partial) {
    throw InputError(folder.path.string() + ": " + std::to_string(records.missing()) + " of " + std::to_string(records.cases()) +
                     " cases are missing: mdat campaign run " + shell_word(folder.path.string()) +
                     " goes on; --partial takes those that are there");
  } else if (folder.campaign().look_every > 0) {
    cut_at_first_missing(table);
  }
  table.counts = counts_of_rows(folder, records, table);
  return table;
}

std::optional<std::uint32_t> ended_after(const CampaignFolder& folder) {
  return folder.plan.look_every == 0 ? std::nullopt : stop_at(folder.campaign(), merged(folder, true));
}

std::string write_results(const CampaignFolder& folder, const ResultTable& table) {
  const Findings all = find(folder.campaign(), table, folder.path.string());
  OutputFolder out(folder.path);
  out.write("results.csv", results_csv(table));
  out.write("results.h5", results_h5(table, folder.plan.campaign, folder.digest));
  out.write("times.csv", times_csv(folder.path, table));
  out.write("summary.json", summary_json(all));
  out.write("junit.xml", junit_xml(all));
  out.commit();
  return summary_text(all);
}

fs::path write_report(const CampaignFolder& folder, const ResultTable& table) {
  const Findings all = find(folder.campaign(), table, folder.path.string());
  OutputFolder out(folder.path);
  Plotter plotter(folder.path);
  out.write("report.html", campaign_html(plotter, all, folder.input.source.name));
  out.commit();
  fs::path report = folder.path / "report.html";
  if (!plotter.missing().empty())
    throw PictureError(report.string() + ": figures are missing: " + plotter.missing() + "; all results are written");
  return report;
}

FlownCase fly_case(const CampaignFolder& folder, std::uint32_t number) {
  if (number >= folder.plan.cases)
    throw InputError("case " + std::to_string(number) + ": the campaign has cases 0 to " + std::to_string(folder.plan.cases - 1));
  const CompiledMission mission = compile_mission(MissionInput(folder.input), ModelCache::of_user_if(folder.cached));
  CaseTable cases(folder.path / kCaseTable);
  const CaseValues values = cases.at(number);
  const CampaignFlight flight(mission, campaign_of(mission.source, folder.plan.campaign), cases.columns());
  CompiledMission own = flight.mission_of(values.numbers);
  for (std::size_t i = 0; i < cases.columns().size(); ++i)
    own.source.settings.push_back(cases.columns()[i] + "=" + cell_text(values.numbers[i]));
  SimulationResult result = simulate(own, flight.options(values.seed, values.numbers));
  std::string fields = record_fields(folder.plan, result.tables[0].variants[0].cases[0]);
  return {std::move(own), std::move(result), std::move(fields)};
}

}  // namespace lasso::mdat
