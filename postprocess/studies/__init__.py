"""The project's own studies. They are not installed: ``scripts/`` puts them on the path.

One study each, run by the script in brackets:

- ``paper`` (``reproduce --full``): the study of the paper, and the report on it
- ``experiment`` (``full-study``): its experiment
- ``two_waves`` (``full-study``): waves under slip
- ``validation`` (``validate``): published results beside those of this program
- ``microgeometry`` (``validate-microgeometry``): predicted beside simulated roughness
- ``accuracy`` (``check-accuracy``): whether errors are what was asked for
- ``periodic`` (``check-periodic``): periodic states against long marches
- ``transients`` (``check-transients``): marches against linear responses
- ``linearity`` (``linearity``): up to which amplitude the linear response holds
- ``error_time`` (``error-vs-time``): error against run time
- ``speed`` (``speed-table``): seconds and work units of the solvers
- ``stability`` (``stability-map``): what becomes of contacts, mild to extreme
- ``many_ranks`` (``many-ranks``): how a sweep would go on more ranks than there are
- ``atlas`` (``atlas``): the atlas that the package ships

Shared by several studies:

- ``programs``: runs the programs of the build, for the tests too; needs the standard library alone
- ``sweeps``: cases as sweeps, and the rows of their results
- ``stages``: the files of a full study
- ``folds``: parts of points that are left out of a fit in turn
- ``section``, ``html``: tables and figures of a report, and its page
- ``work_unit``: the unit that the programs count their work in
"""
