#include "program/program.hpp"

#include <fmt/format.h>
#include <signal.h>
#include <sys/resource.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <chrono>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <new>
#include <stdexcept>

#include "program/atomic_file.hpp"
#include "program/build_info.hpp"
#include "program/hdf5_file.hpp"
#include "program/interruption.hpp"
#include "program/record_file.hpp"

namespace lorentz {
namespace {

using Clock = std::chrono::steady_clock;

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

/// Writes to standard output. Throws UsageError if it is closed or full.
void print(const std::string& text) {
  if (std::fputs(text.c_str(), stdout) < 0 || std::fflush(stdout) != 0)
    throw UsageError(fmt::format(
        "standard output cannot be written: {}. Redirect it to where there is space.", std::strerror(errno)));
}

/// Writes /results/NAME/{mean, standard_error, count} for a measured quantity, {mean, discretisation_error}
/// for a computed one, and the axes beside them as dimension scales attached to the arrays.
void write(Hdf5Writer& file, const Quantity& quantity) {
  const std::string group = "/results/" + quantity.what.name + "/";
  const std::vector<Axis>& axes = quantity.what.axes;
  Shape shape;
  const auto describe = [&](const std::string& array, const std::string& units,
                            const std::string& description) {
    file.attribute(group + array, "units", units);
    file.attribute(group + array, "description", description);
  };
  const auto array = [&](const std::string& name, const auto& values, const std::string& units,
                         const std::string& description) {
    file.dataset(group + name, shape, values);
    describe(name, units, description);
    for (std::size_t i = 0; i < axes.size(); ++i) file.attach_scale(group + name, i, group + axes[i].name);
  };
  for (const Axis& axis : axes) {
    shape.push_back(axis.values.size());
    file.dataset(group + axis.name, {axis.values.size()}, axis.values);
    describe(axis.name, axis.units, axis.description);
    file.make_scale(group + axis.name, axis.name);
  }
  const std::string& units = quantity.what.units;
  array("mean", quantity.mean, units, quantity.what.description);
  if (quantity.control_variates)
    file.attribute(group + "mean", "control_variates", *quantity.control_variates);
  if (quantity.count.empty()) {
    array("discretisation_error", quantity.standard_error, units,
          "Difference from a coarser discretisation, and rounding");
  } else {
    array("standard_error", quantity.standard_error, units, "Standard error of the mean over replicas");
    array("count", quantity.count, "1", "Number of replicas that contribute");
  }
}

}  // namespace

Program::Program(const std::string& name, const std::string& description)
    : options_(name, description), description_(description) {
  constexpr auto runtime = Options::Role::runtime;
  options_.text("--output", output_, "HDF5 file to write, whole or not at all (required)", runtime);
  options_.flag("--overwrite", overwrite_, "Replace an output of other options or of another build", runtime);
  options_.choice("--progress", progress_style_, {"auto", "bar", "log", "none"},
                  "Display of progress on standard error", runtime);
  options_.flag("--describe", describe_, "Print options and quantities as JSON, then exit", runtime);
}

std::string Program::description_in_json() {
  std::vector<std::string> described;
  const auto members = [](const auto& each) {
    return fmt::format(R"("name": {}, "units": {}, "description": {})", as_json(each.name),
                       as_json(each.units), as_json(each.description));
  };
  for (const Description& what : quantities()) {
    std::vector<std::string> axes;
    for (const Axis& axis : what.axes)
      axes.push_back(fmt::format(R"({{{}, "size": {}}})", members(axis), axis.values.size()));
    described.push_back(fmt::format(R"({{{}, "axes": [{}]}})", members(what), fmt::join(axes, ", ")));
  }
  return fmt::format("{{\"program\": {}, \"description\": {},\n\"options\": {},\n\"quantities\": [{}]}}\n",
                     as_json(options_.program()), as_json(description_), options_.describe(),
                     fmt::join(described, ",\n"));
}

/// Throws UsageError if there is an output and it is no result of these options and this build.
void Program::require_replaceable() const {
  std::error_code unknown;
  if (overwrite_ || output_.ends_with(RecordFile::part_suffix) || !std::filesystem::exists(output_, unknown))
    return;
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
  if (file->attribute("/provenance", "program") != AttributeValue(options_.program()))
    refuse("no result of this program");
  if (file->attribute("/provenance", "build_id") != AttributeValue(std::string(build_info.build_id)))
    refuse("a result of another build of this program");
  for (const Parameter& each : options_.parameters())
    if (file->attribute("/parameters", each.name) != each.value)
      refuse("a result with another --" + each.name);
}

void Program::write_result(const Outcome& outcome) const {
  constexpr std::array names{"reached", "not reached", "no target"};
  Hdf5Writer file;
  file.group("/parameters");
  for (const Parameter& parameter : options_.parameters())
    file.attribute("/parameters", parameter.name, parameter.value);
  for (const Quantity& quantity : outcome.results) write(file, quantity);
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
      {"converged", std::string(names.at(static_cast<std::size_t>(outcome.convergence)))},
      {"results_digest", file.digest("/results")},
  };
  for (const Parameter& entry : provenance) file.attribute("/provenance", entry.name, entry.value);
  write_atomically(output_, file.image());
}

ExitStatus Program::run_or_throw(int argc, char** argv) {
  const Clock::time_point start = Clock::now();
  const std::string version =
      fmt::format("{} {} (build {})", options_.program(), build_info.version, build_info.build_id);
  std::optional<std::string> text = options_.parse(argc, argv, version);
  if (!text && describe_) text = description_in_json();
  if (text) {
    print(*text);
    return ExitStatus::done;
  }
  if (output_.empty())
    throw UsageError("--output is missing: the results need a file. Add --output FILE.h5.");
  constexpr std::size_t typical_size = 1 << 18;  // bytes
  for (const std::string& path : {output_, cost_path(output_)}) require_writable(path, typical_size);
  require_replaceable();

  end_on_signals();
  progress_.emplace(options_.program(), progress_style_);
  const Outcome outcome = compute();
  note_signals();  // what is written now is written to its end
  try {
    if (outcome.part.empty())
      write_result(outcome);
    else
      write_atomically(output_, outcome.part);
    const std::string spent = cost(start, outcome.events);
    write_atomically(cost_path(output_), std::as_bytes(std::span(spent)));
  } catch (const UsageError&) {
    after_writing(false);
    throw;
  }
  after_writing(true);
  return outcome.convergence == Convergence::not_reached ? ExitStatus::not_converged : ExitStatus::done;
}

int Program::run(int argc, char** argv) {
  const auto fail = [this](ExitStatus status, const char* kind, std::string what) {
    std::ranges::replace_if(what, [](unsigned char c) { return std::iscntrl(c); }, ' ');  // one line
    std::fputs(fmt::format("{}: {}: {}\n", options_.program(), kind, what).c_str(), stderr);
    return static_cast<int>(status);
  };
  for (const int number : {SIGPIPE, SIGXFSZ}) ::signal(number, SIG_IGN);  // writing then fails with a message
  try {
    return static_cast<int>(run_or_throw(argc, argv));
  } catch (const UsageError& error) {
    return fail(ExitStatus::usage, "error", error.what());
  } catch (const Interrupted& interruption) {
    return static_cast<int>(ExitStatus::interrupted) + interruption.signal;
  } catch (const std::bad_alloc&) {
    return fail(ExitStatus::usage, "error",
                "there is not enough memory. Choose a smaller system, fewer bins or fewer --threads.");
  } catch (const std::length_error&) {
    return fail(
        ExitStatus::usage, "error",
        "an array would exceed the largest possible size. Choose a smaller system, fewer bins or fewer "
        "times.");
  } catch (const NumericalError& error) {
    return fail(ExitStatus::numerical_failure, "numerical failure", error.what());
  } catch (const std::exception& error) {
    return fail(
        ExitStatus::internal_error, "internal error",
        fmt::format("{}. The program is at fault: please report it with the command line.", error.what()));
  }
}

}  // namespace lorentz
