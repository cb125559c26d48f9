#!/usr/bin/env bash
# An ehlwave sweep as a Slurm job. Needs no root. From the top folder of ehlwave:
#
#     sbatch --ntasks=64 scripts/batch/slurm.sh inputs/paper_quick.nml results.h5
#
# 1. Once, on the login node, with the modules or Spack packages of EDIT HERE loaded:
#        scripts/install-requirements --check && scripts/build native
#    (native wants a login node with the processors of the compute nodes; else build release, and say so below.)
# 2. How many cases, on which grids:   build/native/drivers/ehlwave-sweep SWEEP.nml --plan
# 3. Edit what is marked, submit, follow with:   tail -f ehlwave-JOB.log
#
# What to expect: ranks take cases as they become free, so any number of tasks and of nodes will do; more tasks
# than cases are of no use. The results file is renewed every minute and at the end, with the cases finished so
# far. A job that meets its time limit leaves the file of the last minute. RESUMING IS NOT THERE YET: a new job
# computes all cases again. So ask for enough time (the log estimates the time left), or split the sweep into
# several files; ehlwave-post reads several results files together.
# Exit status of the job: 0 all cases converged, 1 some did not (their rows say why), 2 bad input, 3 not written.

# EDIT HERE: account, partition, time. On the command line of sbatch they count more than these.
#SBATCH --job-name=ehlwave
#SBATCH --time=04:00:00
#SBATCH --ntasks=32
#SBATCH --cpus-per-task=1
#SBATCH --mem-per-cpu=1G
#SBATCH --output=ehlwave-%j.log
##SBATCH --account=ACCOUNT
##SBATCH --partition=PARTITION
set -euo pipefail

if [ $# != 2 ]; then
   echo 'Usage, in the top folder of ehlwave: sbatch scripts/batch/slurm.sh SWEEP.nml RESULTS.h5' >&2
   exit 2
fi
# Slurm runs a copy of this script, so only the folder of submission leads to ehlwave.
cd "${SLURM_SUBMIT_DIR:-.}"

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

echo "$(date '+%F %T') job ${SLURM_JOB_ID:-none} on ${SLURM_JOB_NODELIST:-$HOSTNAME}, $EHLWAVE_RANKS ranks"
status=0
# EDIT HERE if your cluster wants srun:   srun --mpi=pmix "$program" "$1" --output "$2" || status=$?
mpi_run "$EHLWAVE_RANKS" "$program" "$1" --output "$2" || status=$?
echo "$(date '+%F %T') exit status $status"
exit "$status"
