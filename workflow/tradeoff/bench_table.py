"""The output of the benchmarks as a table: nanoseconds per event, engine against reference and floor."""

import argparse
import json
from pathlib import Path

import pandas as pd


def medians(path: Path) -> pd.DataFrame:
    """One row per benchmark of a chain: its chain, what was measured, and ns per event."""
    rows = []
    for entry in json.loads(path.read_text())["benchmarks"]:
        kind, *arguments = entry["run_name"].split("/")
        if not kind.startswith(("closed_", "open_")) or entry.get("aggregate_name", "median") != "median":
            continue
        chain, what = kind.split("_")
        parameters = dict(word.split(":") for word in arguments if not word.startswith(("iter", "repeats")))
        gamma = parameters.pop("gamma").replace("0", "N")
        size = " ".join(f"{name}={value}" for name, value in parameters.items())
        row = {"chain": chain, "gamma": gamma, "size": size, "what": what}
        rows.append(row | {"ns": 1e9 / entry["items_per_second"], "particles": entry.get("particles")})
    return pd.DataFrame(rows)


def table(path: Path) -> pd.DataFrame:
    rows = medians(path)
    case = ["chain", "gamma", "size"]
    wide = rows.pivot_table(index=case, columns="what", values="ns", sort=False)
    wide.insert(0, "particles", rows.groupby(case)["particles"].max())
    wide["reference/engine"] = wide["reference"] / wide["engine"]
    wide["engine/floor"] = wide["engine"] / wide["floor"]
    return wide.sort_values(["chain", "gamma", "particles"], ascending=[True, False, True]).reset_index()


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("benchmarks", type=Path, help="JSON of Google Benchmark")
    result = table(parser.parse_args().benchmarks)
    number = {"particles": "{:.0f}".format}
    print(result.to_string(index=False, formatters=number, float_format="{:.1f}".format, na_rep="-"))


if __name__ == "__main__":
    main()
