#include "program/program.hpp"

#include <fmt/format.h>
#include <signal.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <limits>
#include <new>

#include "program/atomic_file.hpp"
#include "program/build_info.hpp"
#include "program/cpu_time.hpp"
#include "program/describe.hpp"
#include "program/hdf5_file.hpp"

namespace lorentz {
namespace {

constexpr std::int64_t format_version = 7;  // FORMAT_VERSION of workflow/lib/load.py, which refuses others

std::string cost_path(const std::string& output) {
  const std::string stem = output.ends_with(".h5") ? output.substr(0, output.size() - 3) : output;
  return stem + ".cost.json";
}

/// Computing time and memory as JSON, stored apart from the results because they differ between runs with
/// equal results.
std::string cost(double wall, double cpu, std::uint64_t events) {
  rusage usage{};
  ::getrusage(RUSAGE_SELF, &usage);
  constexpr std::int64_t bytes_per_unit = 1024;  // Linux reports kilobytes
  return fmt::format(
      "{{\"wall_seconds\": {:.6f}, \"cpu_seconds\": {:.6f}, \"peak_memory_bytes\": {}, \"events\": {}}}\n",
      wall, cpu, usage.ru_maxrss * bytes_per_unit, events);
}

/// Lines of --help: every quantity with its units and axes.
std::string listed(const std::vector<Description>& quantities) {
  std::string lines = "Quantities:\n";
  for (const Description& what : quantities) {
    std::vector<std::string> axes;
    for (const Axis& axis : what.axes) axes.push_back(axis.name);
    const std::string label =
        axes.empty() ? what.name : fmt::format("{} [{}]", what.name, fmt::join(axes, ", "));
    lines += fmt::format("  {:<33} {} [{}]\n", label, what.description, what.units);
  }
  return lines;
}

/// Writes /results/NAME/{mean, standard_error, count} for a measured quantity, {mean, discretisation_error}
/// for a computed one, and the axes beside them as dimension scales attached to the arrays.
void write_quantity(Hdf5Writer& file, const Quantity& quantity) {
  const auto& [name, units, description, axes] = quantity.what;
  const std::string group = "/results/" + name;
  for (const Axis& axis : axes) file.axis(group, axis);
  file.array(group, {"mean", units, description, axes}, quantity.mean);
  if (quantity.control_variates)
    file.attribute(group + "/mean", "control_variates",
                   static_cast<std::int64_t>(quantity.control_variates->used));
  if (quantity.count.empty()) {
    const auto* error = "Bound on the changes with a finer discretisation, and rounding";
    file.array(group, {"discretisation_error", units, error, axes}, quantity.standard_error);
  } else {
    const auto* error = "Standard error of the mean over replicas";
    std::vector<double> errors = quantity.standard_error;  // unknown where all replicas agree
    std::ranges::replace(errors, 0., std::numeric_limits<double>::quiet_NaN());
    file.array(group, {"standard_error", units, error, axes}, errors);
    file.array(group, {"count", "1", "Number of replicas that contribute", axes}, quantity.count);
  }
}

}  // namespace

Program::Program(const std::string& name, const std::string& description)
    : options_(name, description), progress_(name), description_(description) {
  constexpr Role role = Role::execution;
  options_.text(role, "--output", output_, "HDF5 file to write, whole or not at all (required)");
  options_.flag(
      role, "--overwrite", overwrite_,
      "Replace an output of other options or another build; without --resume, discard OUTPUT.checkpoint");
  options_.choice(role, "--progress", progress_.style, {"log", "none"},
                  "Display of progress on standard error");
  options_.flag(role, "--describe", describe_,
                "Check the other options, print options and quantities as JSON, then exit");
}

double Program::elapsed() const {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
}

/// Throws UsageError if there is an output and it is no result of these options and sources.
void Program::require_replaceable() const {
  std::error_code unknown;
  if (overwrite_ || !std::filesystem::exists(output_, unknown)) return;
  const Hdf5Reader file(output_);
  if (!file.has_attribute("/provenance", "source_hash", std::string(build_info.source_hash)) ||
      !file.has_attribute("/provenance", "option_words", options_.option_words()))
    throw UsageError(fmt::format(
        "'{}' exists and is not a result of these options and sources. Choose another --output, or replace "
        "it with --overwrite.",
        output_));
}

ExitStatus Program::write(const RunResult& result) const {
  constexpr std::array names{"reached", "not reached", "no target"};
  Hdf5Writer file;
  for (const char* group : {"/parameters", "/parameter_units", "/parameter_roles", "/parameter_rules"})
    file.group(group);
  for (const auto& [name, value, units, role, rule] : options_.parameters()) {
    file.attribute("/parameters", name, value);
    if (!units.empty() && units != "1") file.attribute("/parameter_units", name, units);
    file.attribute("/parameter_roles", name, role);
    if (!rule.empty()) file.attribute("/parameter_rules", name, rule);
  }
  for (const Quantity& quantity : result.results) write_quantity(file, quantity);
  file.group("/provenance");
  const std::vector<Parameter> provenance = {
      {"format", std::string("lorentz-gas")},
      {"format_version", format_version},
      {"program", options_.program()},
      {"option_words", options_.option_words()},
      {"source_hash", std::string(build_info.source_hash)},
      {"compiler", std::string(build_info.compiler)},
      {"flags", std::string(build_info.flags)},
      {"libraries", std::string(build_info.libraries)},
      {"events", static_cast<std::int64_t>(result.events)},
      {"target_quantity", result.target_quantity},
      {"target_error", result.target_error},
      {"achieved_error", result.achieved_error},
      {"error_without_control_variates", result.plain_error},
      {"converged", std::string(names.at(static_cast<std::size_t>(result.convergence)))},
  };
  for (const auto& [name, value, units, role, rule] : provenance) file.attribute("/provenance", name, value);
  write_atomically(output_, file.image());
  const std::string spent = cost(elapsed(), result.former_seconds + cpu_seconds(), result.events);
  write_atomically(cost_path(output_), std::as_bytes(std::span(spent)));
  return result.convergence == Convergence::not_reached ? ExitStatus::not_converged : ExitStatus::done;
}

int Program::run(int argc, char** argv, const std::function<std::vector<Description>()>& quantities,
                 const std::function<ExitStatus()>& compute) try {
  for (const int number : {SIGPIPE, SIGXFSZ}) ::signal(number, SIG_IGN);  // writing then fails with a message
  for (const int number : {SIGINT, SIGTERM})
    ::signal(number, [](int received) { ::_exit(static_cast<int>(ExitStatus::interrupted) + received); });
  const std::string version =
      fmt::format("{} {} (sources {})", options_.program(), build_info.version, build_info.source_hash);
  std::optional<std::string> text = options_.parse(argc, argv, version, [&] { return listed(quantities()); });
  const std::vector<Description> described = text ? std::vector<Description>() : quantities();
  if (describe_) text = describe(options_, description_, described);
  if (text) {
    if (std::fputs(text->c_str(), stdout) < 0 || std::fflush(stdout) != 0)
      throw UsageError(
          fmt::format("the standard output cannot be written: {}. Choose another.", std::strerror(errno)));
    return 0;
  }
  if (output_.empty() || output_ == "-")
    throw UsageError("--output has no file, which the results need. Add --output FILE.h5.");
  for (const std::string& path : {output_, cost_path(output_)}) require_writable(path);
  require_replaceable();
  return static_cast<int>(compute());
} catch (const UsageError& error) {
  return fail(ExitStatus::usage, fmt::format("error: {}", error.what()));
} catch (const std::bad_alloc&) {
  return fail(
      ExitStatus::usage,
      "error: there is not enough memory. Choose a smaller system, fewer bins, --replicas or --threads.");
} catch (const NumericalError& error) {
  return fail(ExitStatus::numerical_failure, fmt::format("numerical failure: {}", error.what()));
} catch (const std::exception& error) {
  return fail(
      ExitStatus::internal_error,
      fmt::format("internal error: {}. The program is at fault: please report it with the command line.",
                  error.what()));
}

int Program::fail(ExitStatus status, const std::string& message) {
  progress_.warn(message);
  return static_cast<int>(status);
}

}  // namespace lorentz
