#!/usr/bin/env bash
# An ehlwave sweep as a PBS job (PBS Professional, OpenPBS). Needs no root. From the top folder of ehlwave:
#
#     qsub -v sweep=inputs/paper_quick.nml,results=results.h5 scripts/batch/pbs.sh
#
# 1. Once, on the login node, with the modules or Spack packages of EDIT HERE loaded:
#        scripts/install-requirements --check && scripts/build native
#    (native wants a login node with the processors of the compute nodes; else build release.)
# 2. How many cases, on which grids:   build/native/drivers/ehlwave-sweep SWEEP.nml --plan
# 3. Edit what is marked, submit. What is done, what is left:   ehlwave-sweep --status results.h5
#
# What to expect: scripts/batch/job. PBS shows the log (ehlwave.oJOB) when the job ends; "qsub -k oed" on most systems
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
# PBS starts in the home folder; only the folder of submission leads to ehlwave.
cd "${PBS_O_WORKDIR:-.}" || exit 2

# EDIT HERE: a few minutes less than walltime. PBS gives no signal early enough, so the job looks at the clock.
time_limit=3:50:00
# EDIT HERE: the same modules or Spack packages as for the build.
# module purge; module load gcc openmpi fftw hdf5
# . SPACK/share/spack/setup-env.sh; spack load gcc openmpi fftw hdf5
# EDIT HERE if your MPI was built without PBS ("not enough slots", or all ranks on one node):
# export EHLWAVE_LAUNCHER="mpirun --hostfile $PBS_NODEFILE"

if [ ! -f scripts/batch/job ]; then echo "$PWD is not the top folder of ehlwave: submit from there" >&2; exit 2; fi
if [ -z "${sweep:-}" ]; then
   echo 'Usage, in the top folder of ehlwave: qsub -v sweep=SWEEP.nml[,results=RESULTS.h5] scripts/batch/pbs.sh' >&2
   exit 2
fi
set -- "$sweep" ${results:+"$results"}
job=${PBS_JOBID:-none} task='' starts=${starts:-0}
# A job may not put itself back into the queue on most systems, but it may submit its successor.
again() { qsub -v "sweep=$sweep,results=${results:-},starts=$((starts + 1))" scripts/batch/pbs.sh; }
. scripts/batch/job
