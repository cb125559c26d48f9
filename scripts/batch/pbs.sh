#!/usr/bin/env bash
# An ehlwave sweep as a PBS job (PBS Professional, OpenPBS). Needs no root. From the top folder of ehlwave:
#
#     qsub -v sweep=inputs/paper_quick.nml,results=results.h5 scripts/batch/pbs.sh
#
# 1. Once, on the login node, with the modules or Spack packages of EDIT HERE loaded:
#        scripts/install-requirements --check && scripts/build native
#    (native wants a login node with the processors of the compute nodes; else build release, and say so below.)
# 2. How many cases, on which grids:   build/native/drivers/ehlwave-sweep SWEEP.nml --plan
# 3. Edit what is marked, submit. PBS shows the log (ehlwave.oJOB) when the job ends; "qsub -k oed" on most
#    systems lets you follow it.
#
# What to expect: ranks take cases as they become free, so any number of ranks and of nodes will do; more ranks
# than cases are of no use. The results file is renewed every minute and at the end, with the cases finished so
# far. A job that meets its time limit leaves the file of the last minute. RESUMING IS NOT THERE YET: a new job
# computes all cases again. So ask for enough time (the log estimates the time left), or split the sweep into
# several files; ehlwave-post reads several results files together.
# Exit status of the job: 0 all cases converged, 1 some did not (their rows say why), 2 bad input, 3 not written.

# EDIT HERE: nodes, cores, memory, time. mpiprocs is the number of ranks on a node. Torque: -l nodes=2:ppn=16
#PBS -N ehlwave
#PBS -l select=2:ncpus=16:mpiprocs=16:mem=16gb
#PBS -l walltime=04:00:00
#PBS -j oe
##PBS -A ACCOUNT
##PBS -q QUEUE
set -euo pipefail

if [ -z "${sweep:-}" ] || [ -z "${results:-}" ]; then
   echo 'Usage, in the top folder of ehlwave: qsub -v sweep=SWEEP.nml,results=RESULTS.h5 scripts/batch/pbs.sh' >&2
   exit 2
fi
# PBS starts in the home folder; only the folder of submission leads to ehlwave.
cd "${PBS_O_WORKDIR:-.}"

# EDIT HERE: the same modules or Spack packages as for the build.
# module purge; module load gcc openmpi fftw hdf5
# . SPACK/share/spack/setup-env.sh; spack load gcc openmpi fftw hdf5
program=build/native/drivers/ehlwave-sweep

if [ ! -f scripts/environment ]; then
   echo "$PWD is not the top folder of ehlwave: submit from there" >&2
   exit 2
fi
. scripts/environment
# HDF5 locks files; some parallel file systems refuse that ("unable to lock file"):
# export HDF5_USE_FILE_LOCKING=FALSE

# EDIT HERE if your MPI was built without PBS ("not enough slots", or all ranks on one node): Open MPI then
# wants --hostfile "$PBS_NODEFILE" after mpirun, in mpi_run of scripts/environment.
echo "$(date '+%F %T') job ${PBS_JOBID:-none}, $EHLWAVE_RANKS ranks"
status=0
mpi_run "$EHLWAVE_RANKS" "$program" "$sweep" --output "$results" || status=$?
echo "$(date '+%F %T') exit status $status"
exit "$status"
