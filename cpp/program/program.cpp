#include "program/program.hpp"

#include <fmt/format.h>
#include <sys/resource.h>

#include <algorithm>
#include <cctype>
#include <chrono>
#include <filesystem>
#include <new>
#include <nlohmann/json.hpp>
#include <optional>
#include <stdexcept>
#include <string_view>

#include "program/atomic_file.hpp"
#include "program/build_info.hpp"
#include "program/interruption.hpp"
#include "program/parts.hpp"
#include "program/results.hpp"
#include "program/standard_streams.hpp"

namespace lorentz {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::size_t space_asked_for = 1 << 18;  // bytes; larger than a typical output file

double seconds(const timeval& time) {
  return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
}

std::string cost_path(const std::string& output) {
  const std::string stem = output.ends_with(".h5") ? output.substr(0, output.size() - 3) : output;
  return stem + ".cost.json";
}

/// Computing time and memory as JSON, stored apart from the results because they differ between runs with
/// equal results.
std::string cost(Clock::time_point start, std::uint64_t events) {
  rusage usage{};
  ::getrusage(RUSAGE_SELF, &usage);
  constexpr std::int64_t bytes_per_unit = 1024;  // Linux reports kilobytes
  return fmt::format(
      "{{\"wall_seconds\": {:.6f}, \"cpu_seconds\": {:.6f}, \"peak_memory_bytes\": {}, \"events\": {}}}\n",
      std::chrono::duration<double>(Clock::now() - start).count(),
      seconds(usage.ru_utime) + seconds(usage.ru_stime), usage.ru_maxrss * bytes_per_unit, events);
}

std::string_view name_of(Convergence convergence) {
  switch (convergence) {
    case Convergence::reached:
      return "reached";
    case Convergence::not_reached:
      return "not reached";
    case Convergence::no_target:
      return "no target";
  }
  throw std::logic_error("unknown state of convergence");
}

std::string version_text(const std::string& program) {
  return fmt::format("{} {} (build {})", program, build_info.version, build_info.build_id);
}

}  // namespace

Program::Program(const std::string& name, const std::string& description)
    : options_(name, description), description_(description) {
  options_.text("--output", output_, "HDF5 file to write, whole or not at all (required)",
                Options::Role::runtime);
  options_.flag("--overwrite", overwrite_, "Replace an output of other options or of another build",
                Options::Role::runtime);
  options_.choice("--progress", progress_, {"auto", "bar", "log", "none"},
                  "Display of progress on standard error", Options::Role::runtime);
  options_.flag("--describe", describe_, "Print options and quantities as JSON, then exit",
                Options::Role::runtime);
}

void Program::print_description(const std::vector<Description>& quantities) const {
  using nlohmann::json;
  json described = json::array();
  for (const Description& what : quantities) {
    json axes = json::array();
    for (const Axis& axis : what.axes)
      axes.push_back({{"name", axis.name},
                      {"units", axis.units},
                      {"description", axis.description},
                      {"size", axis.values.size()}});
    described.push_back(
        {{"name", what.name}, {"units", what.units}, {"description", what.description}, {"axes", axes}});
  }
  const json all = {{"program", options_.program()},
                    {"description", description_},
                    {"options", options_.describe()},
                    {"quantities", described}};
  print(all.dump(2) + '\n');
}

/// Throws UsageError if there is an output and it is no result of these options and this build.
void Program::require_replaceable() const {
  std::error_code unknown;
  if (overwrite_ || output_.ends_with(Part::suffix) || !std::filesystem::exists(output_, unknown)) return;
  const auto refuse = [this](const std::string& why) {
    throw UsageError(fmt::format(
        "'{}' exists and is {}. Choose another --output, or replace it with --overwrite.", output_, why));
  };
  std::optional<Hdf5Reader> file;
  try {
    file.emplace(output_);
  } catch (const UsageError&) {
    refuse("no result of this program");
  }
  const auto holds = [&](const std::string& group, const std::string& name, const AttributeValue& value) {
    return file->attribute(group, name) == value;
  };
  if (!holds("/provenance", "program", options_.program())) refuse("no result of this program");
  if (!holds("/provenance", "build_id", std::string(build_info.build_id)))
    refuse("a result of another build of this program");
  for (const Parameter& each : options_.parameters())
    if (!holds("/parameters", each.name, each.value)) refuse("a result with another --" + each.name);
}

void Program::write_result(const Outcome& outcome) const {
  Hdf5Writer file;
  file.group("/parameters");
  for (const Parameter& parameter : options_.parameters())
    file.attribute("/parameters", parameter.name, parameter.value);

  file.group("/provenance");
  const std::vector<Parameter> provenance = {
      {"format", std::string("lorentz-gas")},
      {"format_version", std::int64_t{3}},
      {"program", options_.program()},
      {"source_hash", std::string(build_info.source_hash)},
      {"build_id", std::string(build_info.build_id)},
      {"compiler", std::string(build_info.compiler)},
      {"flags", std::string(build_info.flags)},
      {"libraries", std::string(build_info.libraries)},
      {"seed", outcome.seed},
      {"streams", outcome.streams},
      {"events", outcome.events},
      {"target_quantity", outcome.target_quantity},
      {"target_error", outcome.target_error},
      {"achieved_error", outcome.achieved_error},
      {"converged", std::string(name_of(outcome.convergence))},
  };
  for (const Parameter& entry : provenance) file.attribute("/provenance", entry.name, entry.value);

  write_results(file, outcome.results);
  file.attribute("/provenance", "results_digest", file.digest("/results"));
  write_atomically(output_, file.image());
}

void Program::write_output(const Outcome& outcome, const std::string& cost) const try {
  if (outcome.part.empty())
    write_result(outcome);
  else
    write_atomically(output_, outcome.part);
  write_atomically(cost_path(output_), cost);
  outcome.after_writing(true);
} catch (...) {
  outcome.after_writing(false);
  throw;
}

ExitStatus Program::run_or_throw(int argc, char** argv, const Describe& describe, const Compute& compute) {
  const Clock::time_point start = Clock::now();
  if (!options_.parse(argc, argv, version_text(options_.program()))) return ExitStatus::done;
  if (describe_) {
    print_description(describe());
    return ExitStatus::done;
  }
  if (output_.empty())
    throw UsageError("--output is missing: the results need a file. Add --output FILE.h5.");
  for (const std::string& path : {output_, cost_path(output_)}) {
    options_.require_not_configuration(path);
    require_writable(path, space_asked_for);
  }
  require_replaceable();
  watch_for_signals();

  Progress progress(options_.program(), progress_);
  const Outcome outcome = compute(progress);
  write_output(outcome, cost(start, outcome.events));
  return outcome.convergence == Convergence::not_reached ? ExitStatus::not_converged : ExitStatus::done;
}

int Program::run(int argc, char** argv, const Describe& describe, const Compute& compute) {
  const auto complain = [this](const char* kind, std::string what) {
    std::ranges::replace_if(what, [](unsigned char c) { return std::iscntrl(c); }, ' ');  // one line
    print_error(fmt::format("{}: {}: {}\n", options_.program(), kind, what));
  };
  secure_standard_streams();
  try {
    return static_cast<int>(run_or_throw(argc, argv, describe, compute));
  } catch (const UsageError& error) {
    complain("error", error.what());
    return static_cast<int>(ExitStatus::usage);
  } catch (const Interrupted& interruption) {
    return static_cast<int>(ExitStatus::interrupted) + interruption.signal;
  } catch (const std::bad_alloc&) {
    complain("error", "there is not enough memory. Choose a smaller system, fewer bins or fewer --threads.");
    return static_cast<int>(ExitStatus::usage);
  } catch (const std::length_error&) {
    complain("error",
             "an array would exceed the largest possible size. Choose a smaller system, fewer bins or fewer "
             "times.");
    return static_cast<int>(ExitStatus::usage);
  } catch (const NumericalError& error) {
    complain("numerical failure", error.what());
    return static_cast<int>(ExitStatus::numerical_failure);
  } catch (const std::exception& error) {
    complain(
        "internal error",
        fmt::format("{}. The program is at fault: please report it with the command line.", error.what()));
    return static_cast<int>(ExitStatus::internal_error);
  }
}

}  // namespace lorentz
