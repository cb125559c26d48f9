#!/usr/bin/env bash
# An ehlwave sweep as a PBS job (PBS Professional, OpenPBS). Needs no root. From any folder:
#
#     qsub -v sweep=SWEEP.nml,results=results.h5,EHLWAVE_HOME=EHLWAVE EHLWAVE/scripts/batch/pbs.sh
#
# EHLWAVE is the top folder of ehlwave or share/ehlwave of an installation.
# 1. Once, unless it is installed, on the login node, with the modules or Spack packages of EDIT HERE loaded:
#        scripts/install-requirements --check && scripts/build native
#    (native wants a login node with the processors of the compute nodes; else build release.)
# 2. How many cases, on which grids:   ehlwave-sweep SWEEP.nml --plan
# 3. Edit the marked lines, submit. Progress:   ehlwave-sweep --status results.h5
#
# Behaviour: scripts/batch/job. PBS shows the log (ehlwave.oJOB) when the job ends; "qsub -k oed" on most systems
# lets you follow it.

# EDIT HERE: nodes, cores, memory, time. mpiprocs is the number of ranks on a node. Torque: -l nodes=2:ppn=16
#PBS -N ehlwave
#PBS -l select=2:ncpus=16:mpiprocs=16:mem=16gb
#PBS -l walltime=04:00:00
#PBS -r y
#PBS -j oe
##PBS -A ACCOUNT
##PBS -q QUEUE
set -uo pipefail
case ${1:-} in -h | --help) sed -n '2,/^$/s/^# \{0,1\}//p' "$0"; exit 0 ;; esac
# PBS starts in the home folder.
cd "${PBS_O_WORKDIR:-.}" || exit 2

# EDIT HERE: a few minutes less than walltime. PBS gives no signal early enough, so the job looks at the clock.
time_limit=3:50:00
# EDIT HERE in a copy of this script: where it is, as the next start is submitted from there.
# script=$HOME/jobs/pbs.sh
# EDIT HERE: the same modules or Spack packages as for the build.
# module purge; module load gcc openmpi fftw hdf5      # or the module of ehlwave
# . SPACK/share/spack/setup-env.sh; spack load gcc openmpi fftw hdf5
# EDIT HERE if your MPI was built without PBS ("not enough slots", or all ranks on one node):
# export EHLWAVE_LAUNCHER="mpirun --hostfile $PBS_NODEFILE"

# PBS runs a copy of this script without its origin.
home=
for place in "${EHLWAVE_HOME:-}" . "$(dirname "$(command -v run-sweep)")/../share/ehlwave"; do
   if [ -z "$place" ] || [ ! -f "$place/scripts/batch/job" ]; then continue; fi
   home=$(cd "$place" && pwd)
   break
done
if [ -z "$home" ]; then echo 'Where is ehlwave? Give qsub -v EHLWAVE_HOME=its top folder, or load its module' >&2; exit 2; fi
if [ -z "${sweep:-}" ]; then
   echo 'Usage: qsub -v sweep=SWEEP.nml[,results=RESULTS.h5][,EHLWAVE_HOME=FOLDER] pbs.sh' >&2
   exit 2
fi
set -- "$sweep" ${results:+"$results"}
job=${PBS_JOBID:-none} task='' starts=${starts:-0}
# A job may not put itself back into the queue on most systems, but it may submit its successor.
again() { qsub -v "sweep=$sweep,results=${results:-},EHLWAVE_HOME=$home,starts=$((starts + 1))" "${script:-$home/scripts/batch/pbs.sh}"; }
. "$home/scripts/batch/job"
