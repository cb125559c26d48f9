#!/usr/bin/env bash
# An ehlwave sweep as a Slurm job. Needs no root. From any folder:
#
#     sbatch --ntasks=64 EHLWAVE/scripts/batch/slurm.sh SWEEP.nml results.h5
#
# or several sweeps as a job array, each with the results file that it names itself (key output of &sweep):
#
#     sbatch --ntasks=64 --array=0-2 EHLWAVE/scripts/batch/slurm.sh A.nml B.nml C.nml
#
# EHLWAVE is the top folder of ehlwave or share/ehlwave of an installation ($EHLWAVE_HOME with its module).
# 1. Once, unless it is installed, on the login node, with the modules or Spack packages of EDIT HERE loaded:
#        scripts/install-requirements --check && scripts/build native
#    (native wants a login node with the processors of the compute nodes; else build release.)
# 2. How many cases, on which grids:   ehlwave-sweep SWEEP.nml --plan
# 3. Edit the marked lines, submit. Progress:   ehlwave-sweep --status results.h5
#
# Behaviour: scripts/batch/job.

# EDIT HERE: account, partition, time. On the command line of sbatch they count more than these. --signal is the time
# before the limit that the job takes to stop; it covers the longest steady state of a case.
#SBATCH --job-name=ehlwave
#SBATCH --time=04:00:00
#SBATCH --signal=B:USR1@300
#SBATCH --requeue
#SBATCH --open-mode=append
#SBATCH --ntasks=32
#SBATCH --cpus-per-task=1
#SBATCH --mem-per-cpu=1G
#SBATCH --output=ehlwave-%j.log
##SBATCH --account=ACCOUNT
##SBATCH --partition=PARTITION
set -uo pipefail
case ${1:-} in -h | --help) sed -n '2,/^$/s/^# \{0,1\}//p' "$0"; exit 0 ;; esac
cd "${SLURM_SUBMIT_DIR:-.}" || exit 2

# EDIT HERE: the same modules or Spack packages as for the build.
# module purge; module load gcc openmpi fftw hdf5      # or the module of ehlwave
# . SPACK/share/spack/setup-env.sh; spack load gcc openmpi fftw hdf5
# EDIT HERE if your cluster needs srun:
# export EHLWAVE_LAUNCHER='srun --mpi=pmix'

# Slurm runs a copy of this script: the job itself has the original path. A copy of your own works where ehlwave's module
# is loaded, run-sweep is on PATH, or in the top folder of ehlwave.
original=$(scontrol show job "${SLURM_JOB_ID:-0}" 2>/dev/null | sed -n '/^ *Command=/{s///;s/ .*//;p;q;}')
home=
for place in "${EHLWAVE_HOME:-}" "${original%/scripts/batch/*}" . "$(dirname "$(command -v run-sweep)")/../share/ehlwave"; do
   if [ -z "$place" ] || [ ! -f "$place/scripts/batch/job" ]; then continue; fi
   home=$(cd "$place" && pwd)
   break
done
if [ -z "$home" ]; then echo 'Where is ehlwave? Set EHLWAVE_HOME to its top folder or load its module' >&2; exit 2; fi
job=${SLURM_JOB_ID:-none} task=${SLURM_ARRAY_TASK_ID:-} starts=${SLURM_RESTART_COUNT:-0}
again() { scontrol requeue "${SLURM_ARRAY_JOB_ID:+${SLURM_ARRAY_JOB_ID}_}${SLURM_ARRAY_TASK_ID:-$SLURM_JOB_ID}"; }
. "$home/scripts/batch/job"
