"""A study as tasks of Dask: on this machine, or in Slurm jobs that dask-jobqueue submits.

    python dask_study.py                 # two workers on this machine
    python dask_study.py --slurm 8       # eight Slurm jobs, each with one worker
    python dask_study.py --job-script    # print the job that would be submitted

Needs ehlwave-case on PATH, also where the jobs run. For many cases `ehlwave-sweep` is better: it
stores each case at once, and goes on after an interruption.
"""

import argparse
from typing import Any

from distributed import Client, LocalCluster

import ehlwave

WAVELENGTHS = (0.5, 1.0, 2.0)
CASE = {
    "load_parameter_m": 100,
    "lubricant_parameter_l": 10,
    "radius_ratio_d": 1,
    "orientation": "transverse",
    "response": "harmonic",
    "cells_x": 64,
    "cells_y": 64,
}
HERE = "127.0.0.1"


def solve(wavelength_over_a: float) -> tuple[float, float, float]:
    """Return the wavelength over a, Ad/Ai and its relative error."""
    result = ehlwave.Case(**CASE, wavelength_over_a=wavelength_over_a).run()
    return wavelength_over_a, float(result["harmonic_ratio"]), float(result["harmonic_error"])


def slurm_cluster(**scheduler: str) -> Any:  # noqa: ANN401 - of a package that may be absent
    """Return a cluster of Slurm jobs. Edit the options of your cluster."""
    from dask_jobqueue import SLURMCluster

    return SLURMCluster(
        cores=1,
        processes=1,
        memory="2GB",
        walltime="01:00:00",
        job_script_prologue=["module load ehlwave"],
        scheduler_options={"dashboard_address": None, **scheduler},
    )


def main() -> None:
    """Solve the cases, and print a table."""
    parser = argparse.ArgumentParser(description="Ad/Ai of some waves, as tasks of Dask.")
    parser.add_argument("--slurm", type=int, metavar="JOBS", help="Slurm jobs in place of workers")
    parser.add_argument("--job-script", action="store_true", help="print the job, submit nothing")
    options = parser.parse_args()
    if options.job_script:
        with slurm_cluster(host=HERE) as cluster:
            print(cluster.job_script())
        return
    if options.slurm:
        cluster = slurm_cluster()
        cluster.scale(jobs=options.slurm)
    else:
        cluster = LocalCluster(n_workers=2, threads_per_worker=1, host=HERE, dashboard_address=None)
    with cluster, Client(cluster) as client:
        print(f"{'wavelength/a':>12} {'Ad/Ai':>8} {'error':>8}")
        for wavelength, ratio, error in client.gather(client.map(solve, WAVELENGTHS)):
            print(f"{wavelength:12.2f} {ratio:8.4f} {error:8.2%}")


if __name__ == "__main__":
    main()
