"""A sweep is stopped, killed, changed and started again: finished cases stay finished, the rest goes on, the user is
informed.
"""

import contextlib
import math
import os
import shutil
import signal
import subprocess
import time
import unittest
from pathlib import Path

from ehlwave_program import HANGS_S, MPI_ENVIRONMENT, VERSION, FolderTest, environment, is_open_mpi, mpi_command, namelist, run
from hdf5_reading import h5py, read
from store_reading import count_records, finished
from torture import CIRCUMSTANCES

QUICK = {"sweep": {"load_parameter_m": [100, 200], "lubricant_parameter_l": 12.05, "radius_ratio_d": 1,
                   "orientation": ["longitudinal", "transverse"], "wavelength_over_a": 1},
         "grid": {"cells_x": 32, "cells_y": 32}}
# 72 time steps and two checkpoints
LONG = {"sweep": {"load_parameter_m": 100, "lubricant_parameter_l": 12.05, "radius_ratio_d": 1,
                  "orientation": "transverse", "wavelength_over_a": 0.5},
        "grid": {"cells_x": 64, "cells_y": 64}}
# 79 time steps, twelve of which need the rescue ladder
RESCUED = {"sweep": {**LONG["sweep"], "wavelength_over_a": 0.7}, "waviness": {"amplitude_over_film": 1}, "grid": LONG["grid"],
           "solver": {"tolerance": 1e-4, "step_tolerance": 1e-5, "largest_steps": 4}}
# 216 time steps, long enough to be killed in
SLOW = {**LONG, "grid": {"cells_x": 192, "cells_y": 96}}
SLOWER = {**LONG, "grid": {"cells_x": 384, "cells_y": 384}}   # far from done after all output
# two marches of surfaces that touch, of 59 steps each
TOUCHING = {"conditions": {"radius_x_m": 0.01, "reduced_modulus_pa": 226e9, "load_n_per_m": 1e5, "mean_speed_m_per_s": 0.03,
                           "viscosity_pa_s": 0.04},
            "lubricant": {"pressure_viscosity_per_pa": 2.2e-8, "roelands_index": 0.68},
            "waviness": {"orientation": "transverse", "wavelength_over_a": 0.5, "amplitude_m": 2e-7},
            "sweep": {"film_m": [15e-9, 20e-9]}, "grid": {"cells_x": 96, "edges": "truncated"},
            "solver": {"scheme": "averaged"}}
UNFINISHED = 85


class SweepResume(FolderTest):
    def sweep(self, groups, *arguments, status=0, ranks=0):
        (self.folder/"sweep.nml").write_text(namelist(groups))
        outcome = run("sweep", "sweep.nml", *arguments, ranks=ranks, folder=self.folder)
        self.check_status(outcome, status)
        return outcome.stdout + outcome.stderr

    def start(self, *arguments, ranks=0):
        """Start a sweep in the background."""
        command = [os.environ["EHLWAVE_SWEEP"], "sweep.nml", *arguments]
        if ranks:
            command = [*mpi_command(ranks), *command]
        process = subprocess.Popen(command, cwd=self.folder, env=environment(ranks),
                                   stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
        self.addCleanup(process.kill)
        self.addCleanup(process.stdout.close)
        return process

    def wait_for(self, condition):
        end = time.monotonic() + HANGS_S
        while not condition():
            self.assertLess(time.monotonic(), end, "nothing happens")
            time.sleep(0.02)

    def store(self):
        return self.folder/"results.store"

    def check_same(self, first, second):
        _, a = read(self.folder/first)
        _, b = read(self.folder/second)
        self.assertEqual(set(a), set(b))
        for name in set(a) - CIRCUMSTANCES:
            same = a[name] == b[name] if isinstance(a[name], list) else a[name].tobytes() == b[name].tobytes()
            self.assertTrue(same, f"{name}: {a[name]} against {b[name]}")

    def test_changed_surface_is_refused(self):
        """Identities contain the name of a surface file, not its content."""
        groups = {"conditions": {"radius_x_m": 12.52e-3, "radius_y_m": 12.52e-3, "reduced_modulus_pa": 1.17e11, "load_n": 39.2,
                                 "mean_speed_m_per_s": 0.024, "viscosity_pa_s": 1.22},
                  "surface": {"file": "s.h5"}, "grid": {"cells_x": 32, "cells_y": 32}, "dynamics": {"end_time": 0.25},
                  "sweep": {"slip_parameter": [1, 1.2]}}
        for height, status, needle in [(1e-8, 0, ""), (1e-8, 0, "2 of 2 cases found in the store"),
                                       (1.1e-8, 2, "'s.h5' has other numbers than when case 1 was stored")]:
            with h5py.File(self.folder/"s.h5", "w") as file:
                file["x"] = [8e-6*i for i in range(65)]
                file["y"] = [0.0]
                file["height"] = [[height if 20 < i < 40 else 0.0 for i in range(65)]]
            self.assertIn(needle, self.sweep(groups, status=status))
        self.sweep(groups, "--overwrite")

    def test_changed_viscosities_are_refused(self):
        """Nor do they contain a table of viscosities; cases of another law do not read it."""
        table = "pressure_pa,viscosity_pa_s\n0,0.05\n1e8,0.3\n4e8,20\n"
        groups = {"conditions": {"load_parameter_m": 100, "lubricant_parameter_l": 8, "radius_ratio_d": 1},
                  "lubricant": {"viscosity_table": "oil.csv", "temperature_k": 320},
                  "grid": {"cells_x": 32, "cells_y": 32}, "sweep": {"viscosity_law": ["roelands", "table"]}}
        changed = "&lubricant viscosity_table = 'oil.csv' has other numbers than when case 2"
        for last, status, needle in [("1e9,5e3", 0, ""), ("1e9,5000", 0, "2 of 2 cases found in the store"),
                                     ("1e9,5001", 2, changed)]:
            (self.folder/"oil.csv").write_text(table + last)
            self.assertIn(needle, self.sweep(groups, status=status))
        _, data = read(self.folder/"results.h5")
        self.assertEqual(list(data["viscosity_file"]), ["", "oil.csv"])
        old = data["viscosity_digest"][1]
        self.sweep(groups, "--retry", "files", "--time-limit", "0.001", status=UNFINISHED)
        _, data = read(self.folder/"results.h5")
        self.assertEqual(data["viscosity_digest"][1], old, "a row has the digest of the file that its numbers are of")
        self.assertIn("1 of 2 cases found in the store, 1 to run", self.sweep(groups, "--retry", "files"))
        _, data = read(self.folder/"results.h5")
        self.assertNotIn(data["viscosity_digest"][1], ["", old])
        self.assertIn("0 to run", self.sweep(groups))
        (self.folder/"oil.csv").unlink()
        self.assertIn("oil.csv: no such file", self.sweep(groups, status=2))
        self.sweep({**groups, "sweep": {"viscosity_law": ["roelands"]}, "lubricant": {}})

    def write_oil(self, factor=1):
        """A table of viscosities, of which those under pressure are multiplied."""
        rows = [f"{p},{0.05*math.exp(1.6e-8*p)*(factor if p else 1)}" for p in (0, 5e7, 1e8, 2e8, 4e8, 1e9)]
        (self.folder/"new.csv").write_text("\n".join(["pressure_pa,viscosity_pa_s", *rows]))
        (self.folder/"new.csv").replace(self.folder/"oil.csv")

    def write_surface(self, factor=1):
        with h5py.File(self.folder/"s.h5", "w") as file:
            file["x"] = [4e-6*i for i in range(65)]
            file["y"] = [0.0]
            file["height"] = [[factor*4e-8*math.sin(i/3)*(8 <= i <= 56) for i in range(65)]]

    def test_a_march_does_not_go_on_with_another_file(self):
        """A checkpoint holds the past of the old file."""
        cases = {self.write_oil: {**LONG, "lubricant": {"viscosity_law": "table", "viscosity_table": "oil.csv"}},
                 self.write_surface: {"sweep": {"radius_x_m": 12.52e-3}, "grid": LONG["grid"],
                                      "conditions": {"radius_y_m": 12.52e-3, "reduced_modulus_pa": 1.17e11, "load_n": 39.2,
                                                     "mean_speed_m_per_s": 0.024, "viscosity_pa_s": 1.22},
                                      "surface": {"file": "s.h5"}}}
        for write, groups in cases.items():
            write()
            for _ in self.stops(groups):
                if self.starts() and list((self.store()/"checkpoints").iterdir()):
                    break
            write(1.2)
            self.sweep(groups)
            self.sweep(groups, "--output", "fresh.h5")
            self.check_same("fresh.h5", "results.h5")
            for name in ("results", "whole", "fresh"):
                shutil.rmtree(self.folder/f"{name}.store")
                (self.folder/f"{name}.h5").unlink()

    def test_a_file_that_is_changed_while_the_sweep_is_at_work(self):
        """No case is run with other numbers than on rank 0; finished cases stay, with the digest of their numbers."""
        groups = {"sweep": {"load_parameter_m": list(range(50, 90)), "lubricant_parameter_l": 8, "radius_ratio_d": 1},
                  "lubricant": {"viscosity_law": "table", "viscosity_table": "oil.csv"}, "grid": {"cells_x": 64, "cells_y": 64}}
        (self.folder/"sweep.nml").write_text(namelist(groups))
        self.write_oil()
        process = self.start(ranks=2)
        self.wait_for(lambda: self.store().exists() and finished(self.store()))
        self.write_oil(1.2)
        said = process.communicate()[0]
        self.assertEqual(process.returncode, 2, said)
        self.assertIn("ehlwave-sweep: &lubricant viscosity_table = 'oil.csv' was changed while the sweep was at work", said)
        _, data = read(self.folder/"results.h5")
        done = data["status"].count("converged")
        self.assertTrue(0 < done < 40, done)
        self.assertEqual(len(set(data["viscosity_digest"])), 1)
        self.assertEqual({row["viscosity_digest"] for row in finished(self.store()).values()}, set(data["viscosity_digest"]))
        self.assertIn(f"({done} of 40 cases): --retry files runs these once more", self.sweep(groups, status=2))
        self.write_oil()
        self.assertIn(f"{done} of 40 cases found in the store", self.sweep(groups, ranks=2))

    def test_a_store_that_is_moved_away_is_missed(self):
        groups = {**QUICK, "sweep": {**QUICK["sweep"], "load_parameter_m": list(range(100, 110))}}
        (self.folder/"sweep.nml").write_text(namelist(groups))
        process = self.start()
        self.wait_for(lambda: self.store().exists() and finished(self.store()))
        self.store().rename(self.folder/"moved")
        said = process.communicate()[0]
        self.assertEqual(process.returncode, 3, said)
        self.assertIn("results.store: was it moved or removed?", said)
        (self.folder/"moved").rename(self.store())
        self.assertIn("20 of 20 cases found in the store", self.sweep(groups))

    def test_only_what_is_new_runs(self):
        self.sweep(QUICK)
        text = self.sweep(QUICK, ranks=2)
        self.assertIn("4 of 4 cases found in the store, 0 to run", text)
        more = {**QUICK, "sweep": {**QUICK["sweep"], "load_parameter_m": [50, 200]}}
        text = self.sweep(more, ranks=2)
        self.assertIn("2 of 4 cases found in the store, 2 to run", text)
        self.assertIn("2 finished cases that this sweep file does not list", text)
        _, data = read(self.folder/"results.h5")
        self.assertEqual(list(data["load_parameter_m"]), [50, 50, 200, 200])
        self.assertEqual(list(data["run"]), [3, 3, 1, 1])
        self.assertEqual(count_records(self.store(), "case"), 6)

    def test_fields_are_made_when_they_are_asked_for(self):
        self.sweep(QUICK)
        text = self.sweep({**QUICK, "output": {"fields": True}}, ranks=2)
        self.assertIn("4 to run", text)
        fields = sorted((self.store()/"fields").iterdir())
        self.assertEqual([path.stem for path in fields], sorted(finished(self.store())))
        _, data = read(fields[0])
        self.assertEqual(data["pressure"].shape, (17, 33))   # half of the domain
        self.assertIn("0 to run", self.sweep({**QUICK, "output": {"fields": True}}))

    def test_changed_settings_are_said(self):
        self.sweep(QUICK)
        text = self.sweep({**QUICK, "solver": {"tolerance": 1e-5}})
        self.assertIn("4 finished cases that this sweep file does not list", text)
        self.assertIn("an earlier run had tolerance = 9.99", text)
        self.assertNotIn("an earlier run had method", text)

    def test_other_versions_are_said(self):
        self.sweep(QUICK)
        log = next((self.store()/"records").glob("*.log"))
        rewrite_records(log, lambda text: text.replace(f'"{VERSION}"', '"0.0.9"') if text.startswith("run ") else text)
        text = self.sweep(QUICK)
        self.assertRegex(text, r"NOTICE: ehlwave 0\.0\.9 .*computed 4 finished cases, this is ")
        self.assertIn("0 to run", text)
        _, data = read(self.folder/"results.h5")
        self.assertEqual(set(data["program_version"]), {"0.0.9"})
        self.assertIn("4 to run", self.sweep(QUICK, "--retry", "version"))
        _, data = read(self.folder/"results.h5")
        self.assertEqual(set(data["program_version"]), {VERSION})

    def test_failed_cases_are_kept_until_asked_for(self):
        failing = {**QUICK, "solver": {"largest_steps": 1}}
        self.sweep(failing, status=1)
        self.assertIn("0 to run", self.sweep(failing, status=1))
        row = next(iter(finished(self.store()).values()))
        self.assertEqual(row["status"], "stalled")
        self.assertEqual(len(row["residual_history"]), 2)
        self.assertIn("4 to run", self.sweep(failing, "--retry", "failed", status=1))
        _, data = read(self.folder/"results.h5")
        self.assertEqual(data["residual_history"].shape, (4, 2))
        self.assertIn("stalled", self.sweep(failing, "--status", "results.h5", status=1))

    def stops(self, groups):
        """Stop a march again and again, each time at its next checkpoint; yields after every stop until it is done."""
        self.sweep(groups, "--output", "whole.h5")
        limit = 0.02
        for _ in range(30):
            starts = self.starts()
            outcome = run("sweep", "sweep.nml", "--time-limit", f"{limit:.4f}", folder=self.folder)
            if outcome.returncode == 0:
                return
            self.check_status(outcome, UNFINISHED)
            self.assertIn("the time limit is reached", outcome.stdout)
            yield
            if self.starts() == starts:   # a busy machine did not even get to the case
                limit *= 2
        self.fail("it is not done after 30 starts")

    def starts(self):
        """How often a case was begun."""
        return count_records(self.store(), "start")

    def check_stopped_march(self, groups):
        """Stop a march again and again: it ends as without a stop."""
        for _ in self.stops(groups):
            if self.starts():
                self.assertEqual(len(list((self.store()/"checkpoints").iterdir())), 1)
        self.assertGreaterEqual(count_records(self.store(), "stop"), 2)
        self.check_same("whole.h5", "results.h5")
        self.assertEqual(list((self.store()/"checkpoints").iterdir()), [])

    def test_stopped_march_goes_on_bit_for_bit(self):
        self.check_stopped_march(LONG)

    def test_stopped_march_of_fas_that_swings_goes_on_bit_for_bit(self):
        """With an equation of motion, and the linear response, which is kept, too."""
        self.check_stopped_march({**LONG, "solver": {"method": "fas"}, "waviness": {"response": "both"},
                                  "dynamics": {"load_balance": "equation_of_motion", "natural_frequency": 4}})

    def test_stopped_march_with_rescues_goes_on_bit_for_bit(self):
        self.check_stopped_march(RESCUED)
        _, data = read(self.folder/"results.h5")
        self.assertGreater(data["rescued_solutions"][0], 10)

    def test_stopped_march_of_a_starved_contact_goes_on_bit_for_bit(self):
        self.check_stopped_march({**LONG, "inlet": {"oil_over_flooded": 0.8, "oil_change_factor": 0.7}})

    def test_responses_of_a_stopped_sweep_are_those_of_a_whole_one(self):
        """The rest of a group finds its steady state again, on whichever rank."""
        groups = {**QUICK, "waviness": {"response": "harmonic"}, "grid": {"cells_x": 96, "cells_y": 96}}
        groups["sweep"] = {**QUICK["sweep"], "wavelength_over_a": [0.75, 1, 1.5, 2]}
        self.sweep(groups, "--output", "whole.h5")
        process = self.start()
        self.wait_for(lambda: count_records(self.store(), "case"))
        process.terminate()
        process.communicate()
        self.assertEqual(process.returncode, UNFINISHED)
        done = count_records(self.store(), "case")
        self.assertLess(done, 16)
        self.assertIn(f"{16 - done} to run", self.sweep(groups, ranks=2))
        self.check_same("whole.h5", "results.h5")

    def test_stopped_and_killed_marches_of_surfaces_that_touch_go_on_bit_for_bit(self):
        """A sweep over the boundary film, stopped and killed while a checkpoint is there."""
        groups = {**TOUCHING, "sweep": {**TOUCHING["sweep"], "checkpoint_seconds": 0}}
        self.sweep(groups, "--output", "whole.h5")
        checkpoints = self.store()/"checkpoints"

        def written():
            """Times of checkpoints; parts of files that are being written come and go."""
            times = {}
            for path in checkpoints.glob("*"):
                with contextlib.suppress(FileNotFoundError):
                    times[path] = path.stat().st_mtime_ns
            return {path: time_ns for path, time_ns in times.items() if ".part-" not in path.name}

        for end in (subprocess.Popen.terminate, subprocess.Popen.kill):
            known = written()
            process = self.start()
            self.wait_for(lambda old=known: written().items() - old.items())
            end(process)
            process.communicate()
            self.assertNotEqual(process.returncode, 0)
            self.assertTrue(list(checkpoints.iterdir()))
        self.sweep(groups)
        self.check_same("whole.h5", "results.h5")
        self.assertEqual(list(checkpoints.iterdir()), [])

    def test_damaged_checkpoint_is_not_used(self):
        for _ in self.stops(LONG):
            checkpoint = next((self.store()/"checkpoints").iterdir(), None)
            if checkpoint:
                break
        text = bytearray(checkpoint.read_bytes())
        text[len(text)//2] ^= 1
        checkpoint.write_bytes(text)
        self.sweep(LONG)
        self.check_same("whole.h5", "results.h5")

    def test_signals_stop_in_good_order(self):
        (self.folder/"sweep.nml").write_text(namelist(SLOW))
        for ranks, number in [(0, signal.SIGTERM), (2, signal.SIGUSR1)]:
            output = f"results_{ranks}"
            process = self.start("--output", output + ".h5", ranks=ranks)
            self.wait_for(lambda: count_records(self.folder/(output + ".store"), "start") == 1)
            process.send_signal(number)
            text = process.communicate(timeout=HANGS_S)[0]
            # MPICH's mpiexec ends with 0 after SIGUSR1 whatever the status of its ranks; scripts/run-sweep asks the
            # store.
            self.assertIn(process.returncode, [UNFINISHED, 0] if ranks and not is_open_mpi() else [UNFINISHED], text)
            self.assertIn("a signal asked for it", text)
            _, data = read(self.folder/(output + ".h5"))
            self.assertEqual(data["status"], ["pending"])
            self.assertIn("1 left", self.sweep(SLOW, "--status", output + ".h5", status=UNFINISHED))

    def test_two_jobs_on_one_store(self):
        (self.folder/"sweep.nml").write_text(namelist(SLOWER))
        process = self.start()
        self.wait_for(lambda: count_records(self.store(), "start") == 1)
        self.assertIn("in use by another job", self.sweep(SLOWER, status=2))
        self.assertIn("in use by another job", self.sweep(SLOWER, "--overwrite", status=2, ranks=2))
        self.assertIn("a job is at work", self.sweep(SLOWER, "--status", "sweep.nml", status=UNFINISHED))
        process.kill()
        process.communicate()
        self.assertIn("no job is at work", self.sweep(SLOWER, "--status", "results.store", status=UNFINISHED))

    def test_case_that_kills_its_rank_twice_is_set_aside(self):
        rows = ["load_parameter_m,lubricant_parameter_l,radius_ratio_d,orientation,wavelength_over_a,cells_x,cells_y",
                "100,12.05,1,transverse,0.5,64,64", "100,12.05,1,longitudinal,1,32,32"]
        (self.folder/"cases.csv").write_text("\n".join(rows) + "\n")
        groups = {"sweep": {"case_file": "cases.csv"}}
        (self.folder/"sweep.nml").write_text(namelist(groups))
        for deaths in [1, 2]:
            process = self.start()
            self.wait_for(lambda: count_records(self.store(), "start") == deaths)
            process.kill()
            process.communicate()
        text = self.sweep(groups, status=1, ranks=2)
        self.assertIn("case 1 is set aside", text)
        _, data = read(self.folder/"results.h5")
        self.assertEqual(data["status"][0], "crashed")
        self.assertIn(data["status"][1], ["converged", "unresolved"])
        self.assertIn("0 to run", self.sweep(groups, status=1))
        self.sweep(groups, "--retry", "failed")
        _, data = read(self.folder/"results.h5")
        self.assertNotIn("crashed", data["status"])

    def test_case_over_its_budget(self):
        groups = {**SLOW, "sweep": {**SLOW["sweep"], "wavelength_over_a": [0.5, 2], "largest_case_seconds": 0.01}}
        text = self.sweep(groups, status=1)
        _, data = read(self.folder/"results.h5")
        self.assertEqual(data["status"], ["over_budget", "over_budget"])
        self.assertIn("time step 1 of", data["message"][0])
        self.assertIn("2 over_budget", text)
        self.assertGreater(data["residual_history"].shape[1], 1)

    def test_stores_that_are_refused(self):
        self.sweep(QUICK)
        (self.store()/"store").write_text("ehlwave-store 2\n")
        self.assertIn("ehlwave-store 2", self.sweep(QUICK, status=2))
        self.assertIn("ehlwave-store 2", self.sweep(QUICK, "--status", "results.h5", status=2))
        (self.store()/"store").unlink()   # the line is lost, not the result
        self.assertIn("4 of 4 cases found in the store", self.sweep(QUICK))
        (self.folder/"new.store"/"records").mkdir(parents=True)
        (self.folder/"new.store"/"lock").write_text("")
        self.sweep(QUICK, "--output", "new.h5")
        (self.folder/"other.store").mkdir()
        (self.folder/"other.store"/"precious").write_text("")
        self.assertIn("not the store of a sweep", self.sweep(QUICK, "--output", "other.h5", "--overwrite", status=2))
        self.assertTrue((self.folder/"other.store"/"precious").exists())
        self.assertIn("there is no store", self.sweep(QUICK, "--status", "missing.h5", status=2))
        self.assertIn("H:MM:SS", self.sweep(QUICK, "--time-limit", "soon", status=2))
        self.assertIn("failed, version, files", self.sweep(QUICK, "--retry", "all", status=2))

    def test_damaged_records_count_as_not_written(self):
        self.sweep(QUICK)
        log = next((self.store()/"records").glob("*.log"))
        text = log.read_bytes()
        last = text.rstrip(b"\n").rfind(b"\n") + 1
        for broken in [text[:-1], text[:last + 40], text[:last + 60] + b"x" + text[last + 61:], text[:last] + b"\n\0\n"]:
            log.write_bytes(broken)
            self.assertIn("3 finished, 1 left", self.sweep(QUICK, "--status", "results.h5", status=UNFINISHED))
        self.assertIn("3 of 4 cases found in the store, 1 to run", self.sweep(QUICK))
        self.assertIn("4 finished, 0 left", self.sweep(QUICK, "--status", "results.h5"))

    def test_launcher_goes_on_after_a_death(self):
        script = Path(__file__).parents[2]/"scripts"/"run-sweep"
        (self.folder/"sweep.nml").write_text(namelist(SLOW))
        variables = {**os.environ, **MPI_ENVIRONMENT, "OMPI_MCA_oob_tcp_if_include": "lo",
                       "OMPI_MCA_btl_tcp_if_include": "lo"}
        command = ["bash", script, "--ranks", "1", "--restarts", "1", "sweep.nml", "--time-limit", "1:00:00"]
        process = subprocess.Popen(command, cwd=self.folder, env=variables, stdout=subprocess.PIPE,
                                   stderr=subprocess.STDOUT, text=True)
        self.addCleanup(process.kill)
        self.addCleanup(process.stdout.close)
        for deaths in [1, 2]:
            self.wait_for(lambda: count_records(self.store(), "start") == deaths)
            header = next(record for record in self.records(deaths) if record.startswith("run "))
            os.kill(int(header.split("]],[")[1].split(",")[4]), signal.SIGKILL)
        text = process.communicate(timeout=HANGS_S)[0]
        self.assertEqual(process.returncode, 4, text)
        self.assertIn("restart 1 of at most 1", text)
        self.assertIn("ranks died 2 times", text)

    def test_pbs_job_submits_its_successor(self):
        root = Path(__file__).parents[2]
        (self.folder/"sweep.nml").write_text(namelist(LONG))
        script = (root/"scripts"/"batch"/"pbs.sh").read_text()
        self.assertIn("time_limit=3:50:00", script)
        (self.folder/"pbs.sh").write_text(script.replace("time_limit=3:50:00", "time_limit=0.05"))
        qsub = self.folder/"qsub"   # there is no PBS here; that it is asked for the right thing can be seen
        qsub.write_text("#!/bin/sh\necho \"$@\" >>\"$QSUB_LOG\"\n")
        qsub.chmod(0o755)
        variables = {**os.environ, **MPI_ENVIRONMENT, "PBS_JOBID": "7.server", "PBS_O_WORKDIR": str(root), "starts": "3",
                       "EHLWAVE_RANKS": "1", "PATH": f"{self.folder}:{os.environ['PATH']}", "QSUB_LOG": str(self.folder/"log"),
                       "sweep": str(self.folder/"sweep.nml"), "results": str(self.folder/"results.h5")}
        outcome = subprocess.run(["bash", self.folder/"pbs.sh"], env=variables, capture_output=True, text=True, check=False)
        self.check_status(outcome, UNFINISHED)
        self.assertIn("job 7.server: start 4 on", outcome.stdout)
        self.assertEqual((self.folder/"log").read_text(), f"-v sweep={self.folder}/sweep.nml,results={self.folder}/results.h5,"
                         f"EHLWAVE_HOME={root},starts=4 {root}/scripts/batch/pbs.sh\n")
        _, data = read(self.folder/"results.h5")
        self.assertEqual((data["job"], data["status"]), ([""], ["pending"]))

    def records(self, number):
        from store_reading import records
        return records(self.store()/"records"/f"{number:06}-000000.log")


def rewrite_records(path, change):
    """Change records of a log, checksums made to fit."""
    import zlib
    from store_reading import records
    lines = []
    for record in records(path):
        text = change(record).encode()
        lines.append(b"%08x %d %s\n" % (zlib.crc32(text), len(text), text))
    path.write_bytes(b"".join(lines))


if __name__ == "__main__":
    unittest.main()
