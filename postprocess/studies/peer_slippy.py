"""The contact of the study of peers by slippy; run by the Python that has it, with data as JSON."""

import json
import math
import sys


def main(text: str) -> None:
    """Solve, and print the film at the contact centre in um; as in the example of slippy itself."""
    import slippy

    slippy.CUDA = False
    import slippy.contact as c
    import slippy.surface as s

    data = json.loads(text)
    radius, points, poisson = data["radius"], data["points"], 0.3
    young = data["modulus"] * (1 - poisson**2)
    roelands = 1.96e8
    index = data["alpha"] * roelands / (math.log(data["viscosity"]) + 9.67)
    flats = [float("inf")] * 2
    hertz = c.hertz_full([radius] * 2, flats, [young] * 2, [poisson] * 2, data["load"])
    a, pressure = hertz["contact_radii"][0], hertz["max_pressure"]
    side = 2 * data["width"] * a
    ball = s.RoundSurface((radius,) * 3, shape=(points,) * 2, extent=(side, side), generate=True)
    flat = s.FlatSurface()
    ball.material = flat.material = c.Elastic("steel", {"E": young, "v": poisson})
    oil, laws = c.Lubricant("oil"), c.lubricant_models
    oil.add_sub_model(
        "nd_viscosity", laws.nd_roelands(data["viscosity"], roelands, pressure, index)
    )
    oil.add_sub_model("nd_density", laws.nd_dowson_higginson(pressure))
    model = c.ContactModel("peer", ball, flat, oil)
    reynolds = c.UnifiedReynoldsSolver(
        time_step=0,
        grid_spacing=ball.grid_spacing,
        hertzian_pressure=pressure,
        radius_in_rolling_direction=radius,
        hertzian_half_width=a,
        dimentional_viscosity=data["viscosity"],
        dimentional_density=850,
    )
    x, y = ball.get_points_from_extent()
    x, y = x + ball._total_shift[0], y + ball._total_shift[1]
    step = c.IterSemiSystem(
        "main",
        reynolds,
        data["speed"],
        1,
        no_time=True,
        normal_load=data["load"],
        initial_guess=[hertz["total_deflection"], hertz["pressure_f"](x, y)],
        relaxation_factor=0.05,
        max_it_interference=3000,
    )
    model.add_step(step)
    state = model.solve()
    if not state["converged"]:
        sys.exit("slippy did not converge")
    print(f"film {1e6 * state['gap'][points // 2, points // 2]:.10g}")


if __name__ == "__main__":
    main(sys.argv[1])
