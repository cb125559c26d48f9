"""A private Slurm: two nodes on loopback, without systemd, in a folder with all its files."""

import getpass
import os
import shutil
import socket
import subprocess
import time
from pathlib import Path

PROGRAMS = ["slurmctld", "slurmd", "sbatch", "squeue", "scontrol", "munged", "mungekey"]
NODES = 2

CONFIGURATION = """
ClusterName=private
SlurmctldHost={host}(127.0.0.1)
SlurmctldPort={port}
CommunicationParameters=NoCtldInAddrAny,NoInAddrAny,DisableIPv6
SlurmUser={user}
SlurmdUser={user}
AuthType=auth/munge
CredType=cred/munge
AuthInfo=socket={folder}/munge/socket
StateSaveLocation={folder}/state
SlurmdSpoolDir={folder}/spool.%n
TmpFS={folder}/tmp.%n
SlurmctldPidFile={folder}/slurmctld.pid
SlurmdPidFile={folder}/slurmd.%n.pid
SlurmctldLogFile={folder}/slurmctld.log
SlurmdLogFile={folder}/slurmd.%n.log
SlurmdParameters=config_overrides
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SwitchType=switch/none
MpiDefault=none
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
SchedulerParameters=bf_interval=5
ReturnToService=2
KillWait=5
JobRequeue=1
SlurmdTimeout=30
DefMemPerCPU=100
AccountingStorageType=accounting_storage/none
JobAcctGatherType=jobacct_gather/linux
JobCompType=jobcomp/none
"""


def missing():
    """Missing programs; empty when a Slurm can be started."""
    return [name for name in PROGRAMS if not shutil.which(name)]


class PrivateSlurm:
    """Started by `start`, ended by `stop`; `environment` holds the variables for sbatch and the other commands."""

    def __init__(self, folder):
        self.folder = Path(folder)
        self.environment = {**os.environ, "SLURM_CONF": str(self.folder/"slurm.conf")}
        self.pids = []

    def start(self):
        """Bring both nodes up; returns False when they do not come."""
        for name in ["munge", "state", *[f"{kind}.n{n}" for n in range(1, NODES + 1) for kind in ("spool", "tmp")]]:
            (self.folder/name).mkdir(mode=0o755)
        (self.folder/"munge").chmod(0o711)
        self.folder.chmod(0o755)
        port = _free_port(NODES + 1)
        host = socket.gethostname().split(".")[0]
        text = CONFIGURATION.format(host=host, port=port, user=getpass.getuser(), folder=self.folder)
        for n in range(1, NODES + 1):
            text += f"NodeName=n{n} NodeHostname={host} NodeAddr=127.0.0.1 Port={port + n} CPUs=4 RealMemory=2000\n"
        text += f"PartitionName=test Nodes=n[1-{NODES}] Default=YES MaxTime=INFINITE State=UP\n"
        (self.folder/"slurm.conf").write_text(text)
        munge = self.folder/"munge"
        self.call("mungekey", "--create", "--keyfile", munge/"key")
        self.call("munged", f"--key-file={munge}/key", f"--socket={munge}/socket", f"--pid-file={munge}/pid",
                  f"--log-file={munge}/log", f"--seed-file={munge}/seed", "--force")
        self.call("slurmctld", "-i")
        for n in range(1, NODES + 1):
            self.call("slurmd", "-N", f"n{n}")
        end = time.monotonic() + 60
        while self.call("sinfo", "-h", "-t", "idle", "-o", "%D", check=False).strip() != str(NODES):
            if time.monotonic() > end:
                return False
            time.sleep(0.5)
        return True

    def call(self, *command, check=True, cwd=None):
        """Output of a command of Slurm."""
        return subprocess.run([*map(str, command)], env=self.environment, check=check, capture_output=True, text=True,
                              cwd=cwd).stdout

    def stop(self):
        """Cancel running jobs and end the daemons that `start` started."""
        self.call("scancel", "-u", getpass.getuser(), check=False)
        time.sleep(1)
        for path in [*sorted(self.folder.glob("slurm*.pid"), reverse=True), self.folder/"munge"/"pid"]:
            try:
                os.kill(int(path.read_text()), 15)
            except (OSError, ValueError):
                pass
        time.sleep(2)


def _free_port(count):
    """First of some ports in a row that nobody listens to."""
    for port in range(16817, 17800, 10):
        sockets = []
        try:
            for n in range(count):
                one = socket.socket()
                sockets.append(one)
                one.bind(("127.0.0.1", port + n))
            return port
        except OSError:
            continue
        finally:
            for one in sockets:
                one.close()
    raise OSError("no free ports")
