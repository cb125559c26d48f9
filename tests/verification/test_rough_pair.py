"""Two rough surfaces: marches against the sum of both linear responses, the effect of both on the mean film, maps on
both.

A wave of surface j is the real part of A_j exp(i (k_j X - w_j T)); H(0,0) has the real part of A_j T_j exp(-i w_j T).
"""

import cmath
import math
import tempfile
import unittest
from pathlib import Path

from ehlwave_program import TestCase, namelist, report, run, solve
from hdf5_reading import h5py, read   # skips where there is none
from numpy import exp

GRID = {"cells_x": 64, "cells_y": 64}
SLIDING = {"slip_parameter": 1.25}
START = -2.5                       # X of the inlet: crests of both patterns are there at T = 0
BY_MODEL = {"error_estimate": "model"}


def wave(length, amplitude=0.01, response="both"):
    keys = {"orientation": "transverse", "wavelength_over_a": length, "amplitude_over_film": amplitude}
    return keys if response is None else {**keys, "response": response}


def transfer(result, number=""):
    return complex(result["harmonic_real" + number], result["harmonic_imaginary" + number])


def march(result, number=""):
    return cmath.rect(result["amplitude_ratio_fit" + number], result["phase_fit" + number])


class RoughPair(TestCase):
    def test_march_is_the_sum_of_both_responses(self):
        """Waves of 1 % on both surfaces, S = 1.25 and 0.75: film at the centre at all times, within 0.5 % of Ai."""
        for name, m, d, grid in (("circular", 100, 1, GRID), ("line", 50, 0, {"cells_x": 256})):
            with self.subTest(contact=name), tempfile.TemporaryDirectory() as folder:
                lengths = (1.0, 0.7)
                text = namelist({"conditions": {"load_parameter_m": m, "lubricant_parameter_l": 12.05, "radius_ratio_d": d, **SLIDING},
                                 "waviness": wave(lengths[0]), "waviness2": wave(lengths[1], response=None), "grid": grid,
                                 "solver": {**BY_MODEL, "settling_periods": 3}})
                Path(folder, "pair.nml").write_text(text)
                outcome = run("case", "pair.nml", "--output", "pair.h5", folder=folder)
                self.check_status(outcome)
                _, data = read(Path(folder, "pair.h5"))
                film = float(data["central_film"])
                settled = data["time"] > data["time"][-1] - 4
                predicted = film
                for number, length, speed in (("", lengths[0], 1.25), ("_2", lengths[1], 0.75)):
                    k = 2*math.pi/length
                    response = transfer(data, number)
                    crest = cmath.exp(-1j*k*START)       # phase of the pattern that has a crest at the inlet at T = 0
                    turns = exp(-1j*k*speed*data["time"][settled])
                    predicted = predicted + 0.01*film*(response*crest*turns).real
                    self.assertLess(abs(march(data, number) - response), 0.005, number)
                found = data["film_at_centre"][settled]
                difference = abs(found - found.mean() - (predicted - predicted.mean())).max()/(0.01*film)
                self.assertLess(difference, 0.005)
                report(f"{name}: march less the sum of both responses {100*difference:.2f} % of Ai")

    def test_periodic_state_of_two_equal_wavelengths(self):
        """Their periods are as 3 to 5: the state repeats after 5 of the first."""
        groups = {"m": 100, "d": 1, "grid": GRID, "conditions": SLIDING, "waviness2": wave(1, 0.05, None)}
        state = solve(**groups, waviness=wave(1, 0.05, "periodic"), solver=BY_MODEL)
        settled = solve(**groups, waviness=wave(1, 0.05, "both"), solver={**BY_MODEL, "settling_periods": 4})
        self.assertEqual((settled["march_from"], state["march_from"]), ("rest", "waves"))
        for number in ("", "_2"):
            self.assertLess(abs(march(state, number) - march(settled, number)), 3e-3)
        rise, slow = (result["mean_film"] - result["central_film"] for result in (state, settled))
        self.check_close(rise, slow, 0.05, "rise of the mean film in the march")
        expected = settled["mean_film_rise_both"]*0.05*settled["central_film"]
        self.check_close(rise, expected, 0.05, "rise of the mean film to second order")
        report(f"Ad/Ai {abs(march(state)):.5f} and {abs(march(state, '_2')):.5f}, march from rest {abs(march(settled)):.5f} "
               f"and {abs(march(settled, '_2')):.5f}; rise over that to second order {rise/expected:.3f}")

    def test_overtones_of_the_larger_waves(self):
        """Half the wavelength and a small part of the height: what has their frequency is an overtone. Other wavelengths are fitted beside it."""
        groups = {"m": 100, "d": 1, "grid": GRID, "solver": BY_MODEL}
        for height, small in ((0.3, 0.02), (0.1, 1e-6)):
            pair = solve(**groups, waviness=wave(1, height), waviness2=wave(0.5, small, None))
            self.assertIsNone(pair["amplitude_ratio_fit_2"])
            self.assertIn("no Ad/Ai of surface 2: overtones", pair["warning"])
            self.check_close(pair["amplitude_ratio_fit"], solve(**groups, waviness=wave(1, height))["amplitude_ratio_fit"], 0.01, "larger waves")
        alike = solve(**groups, waviness=wave(1, 0.05, "both"), waviness2=wave(0.5, 0.05, None))
        off = abs(alike["amplitude_ratio_fit_2"]/alike["harmonic_ratio_2"] - 1)
        report(f"equal heights: off by {off:.2%}, declared {alike['ratio_error_amplitude']:.2%}")
        self.assertLess(off, 0.02)
        self.assertGreaterEqual(alike["ratio_error_amplitude"], off)
        apart = solve(**groups, waviness=wave(1, 0.3, "both"), waviness2=wave(0.6, 0.02, None))
        off = abs(apart["amplitude_ratio_fit_2"]/apart["harmonic_ratio_2"] - 1)
        report(f"0.02 of 0.6 a beside 0.3: off by {off:.2%}")
        self.assertLess(off, 0.05)

    def test_the_error_is_that_of_the_worse_surface(self):
        """Short waves on either surface: equivalent inputs give the same result."""
        found = []
        for slip, lengths in ((1.5, (2, 0.4)), (0.5, (0.4, 2))):
            pair = solve(m=100, d=1, grid={"cells_x": 96, "cells_y": 64}, conditions={"slip_parameter": slip},
                         waviness=wave(lengths[0], 0.05, "harmonic"), waviness2=wave(lengths[1], 0.05, None))
            self.assertEqual(pair["ratio_error_mesh"], max(pair["harmonic_error"], pair["harmonic_error_2"]))
            found.append(pair["error_estimate"])
        self.check_close(found[0], found[1], 1e-6, "error_estimate")
        accurate = solve(m=100, d=1, conditions={"slip_parameter": 1.5}, waviness=wave(2, 0.05, "harmonic"), waviness2=wave(0.4, 0.05, None),
                         grid={"cells_x": 0, "cells_y": 0, "edges": "flooded"}, solver={"accuracy": 0.1})
        self.assertTrue(accurate["status"] == "inaccurate" or max(accurate["harmonic_error"], accurate["harmonic_error_2"]) <= 0.1)

    def test_one_pattern_in_two_parts(self):
        """In pure rolling equal waves on both surfaces act as a single wave with the sum of their amplitudes: Ai and 2
        Ai as 3 Ai.
        """
        groups = {"m": 100, "d": 1, "grid": GRID, "solver": {**BY_MODEL, "step_tolerance": 1e-7}}
        parts = solve(**groups, waviness=wave(0.9, 0.05), waviness2=wave(0.9, 0.1, None))
        whole = solve(**groups, waviness=wave(0.9, 0.15))
        for number in ("", "_2"):
            self.check_close(parts["amplitude_ratio_fit" + number], whole["amplitude_ratio_fit"], 1e-6, "Ad/Ai")
        self.check_close(parts["mean_film"], whole["mean_film"], 1e-7, "mean film, of samples that fill no whole periods")
        self.check_close(parts["mean_film_rise_both"], 3*whole["mean_film_rise"], 1e-3, "rise by both, over Ai of the first")
        self.check_close(parts["mean_film_rise_cross"], 4/9*parts["mean_film_rise_both"], 1e-3, "part that neither has alone")
        self.check_close(parts["smallest_film_both"], whole["smallest_film"], 1e-3, "smallest film")
        apart = solve(**groups, waviness=wave(1, 0.05, "harmonic"), waviness2=wave(0.8, 0.1, None))
        self.assertEqual(apart["mean_film_rise_cross"], 0)
        self.check_close(apart["mean_film_rise_both"], apart["mean_film_rise"] + 2*apart["mean_film_rise_2"], 1e-12, "rise apart")
        rms = math.hypot(0.05*apart["harmonic_ratio"], 0.1*apart["harmonic_ratio_2"])/math.sqrt(2)
        self.check_close(apart["film_rms_both"], rms, 1e-12, "rms")

    def test_maps_on_both_surfaces(self):
        """Rq of 10 % of the film together: film at the centre against the responses to the waves of both, 4 % of Rq."""
        conditions = {"radius_x_m": 12.52e-3, "radius_y_m": 12.52e-3, "reduced_modulus_pa": 1.17e11, "load_n": 39.2,
                      "mean_speed_m_per_s": 0.024, "viscosity_pa_s": 1.22, **SLIDING}
        a, step, points = 184.614e-6, 8e-6, 281
        length = (points - 1)*step/a
        solver = {**BY_MODEL, "settling_periods": 0}
        smooth = solve(conditions=conditions, grid=GRID)
        rq = 0.1*smooth["central_film_um"]*1e-6/math.sqrt(2)      # Rq of each map
        waves = {"": [(0.9, 1.0, 0.3), (1.4, 0.8, 2.0)], "_2": [(1.1, 1.0, 4.0), (1.7, 0.6, 1.0)]}   # lambda/a, share, phase
        with tempfile.TemporaryDirectory() as folder:
            for number, of in waves.items():
                scale = rq/math.sqrt(sum(share**2/2 for _, share, _ in of))
                ends = [min(1, i*step/(0.8*a), (points - 1 - i)*step/(0.8*a)) for i in range(points)]
                heights = [scale*math.sin(math.pi/2*end)**2*sum(
                    share*math.cos(2*math.pi*i*step/(lam*a) + phase) for lam, share, phase in of) for i, end in enumerate(ends)]
                with h5py.File(Path(folder, f"s{number}.h5"), "w") as file:
                    file["height"], file["x"], file["y"] = [heights], [i*step for i in range(points)], [0.0]
            Path(folder, "maps.nml").write_text(namelist({
                "conditions": conditions, "surface": {"file": "s.h5"}, "surface2": {"file": "s_2.h5"}, "grid": GRID,
                "dynamics": {"end_time": 10}}))
            outcome = run("case", "maps.nml", "--output", "maps.h5", folder=folder)
            self.check_status(outcome)
            _, data = read(Path(folder, "maps.h5"))
        # both maps fill the inlet and the contact, and earlier patterns have passed
        first, last = (-START + 1.8)/0.75, (length - START - 1.8)/1.25
        span = (data["time"] > first) & (data["time"] < last)
        self.assertGreater(span.sum(), 20)
        time, predicted = data["time"][span], 0
        for number, speed in (("", 1.25), ("_2", 0.75)):
            self.assertAlmostEqual(data[f"surface_position{number}_m"][0], a*(length - START), delta=1e-9)
            scale = rq/math.sqrt(sum(share**2/2 for _, share, _ in waves[number]))
            for lam, share, phase in waves[number]:
                response = transfer(solve(conditions=conditions | {"slip_parameter": speed}, grid=GRID,
                                          waviness=wave(lam, 0.01, "harmonic"), solver=solver))
                k = 2*math.pi/lam
                turns = exp(1j*(k*(length - START - speed*time) + phase))
                predicted = predicted - scale*share*(response*turns).real
        film = data["film_at_centre"][span]*float(data["hertz_approach_c_m"])
        difference = film - film.mean() - (predicted - predicted.mean())
        error = math.sqrt((difference**2).mean())/math.hypot(rq, rq)
        self.assertLess(error, 0.04)
        report(f"maps: rms of march less linear prediction {100*error:.2f} % of Rq, over {span.sum()} steps")


if __name__ == "__main__":
    unittest.main()
