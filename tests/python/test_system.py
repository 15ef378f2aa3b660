import gnomon
import numpy
import pytest

scipy_integrate = pytest.importorskip("scipy.integrate")


def test_the_jacobian_is_the_derivative_of_the_residual(pin):
    model = gnomon.Model(pin)
    system, state = model.system, model.start()
    alpha, n = 0.3, model.system.size
    J = system.jacobian(state.t, state.y, state.ydot, alpha)
    assert J.shape == (n, n) and J.nnz > n
    rng = numpy.random.default_rng(1)
    for _ in range(5):
        direction = rng.standard_normal(n) * system.unknown_scale
        h = 1e-6
        ahead = system.residual(0, state.y + h * direction, state.ydot + h * alpha * direction)
        behind = system.residual(0, state.y - h * direction, state.ydot - h * alpha * direction)
        difference = (ahead - behind) / (2 * h) / system.row_scale
        product = (J @ direction) / system.row_scale
        assert numpy.abs(product).max() > 1e-3
        assert numpy.abs(product - difference).max() < 1e-5 * numpy.abs(product).max()


def test_scipy_integrates_the_reduced_equation(springs):
    """Radau of scipy on d' = rate(d), with the contact solved inside, against the closed form."""
    model = gnomon.Model(springs)
    system, start = model.system, model.start()
    differential = system.differential
    y = start.y.copy()

    def rate(t, d):
        y[differential] = d
        state = system.consistent(t, y)
        y[:] = state.y  # the first guess of the next solve
        return state.ydot[differential]

    solved = scipy_integrate.solve_ivp(rate, (0, 1000), start.y[differential], "RK45", rtol=1e-6, atol=1e-10)
    assert solved.success
    ours = gnomon.run(springs.with_({"integrator.rtol": 1e-8, "integrator.atol": 1e-12})).state.y[differential]
    assert numpy.abs(solved.y[:, -1] - ours).max() < 2e-5 * ours.max()


def test_switching_tells_the_nodes_in_contact(springs):
    model = gnomon.Model(springs)
    state = model.start()
    active = model.system.switching(0, state.y) <= 0
    assert active.sum() == model.observe(state)["contact_nodes"] == model.contact(state)["active"].sum()


def test_a_branch_is_smooth_beyond_its_border(pin):
    """On a frozen branch the residual is differentiable where by sign it has a kink."""
    model = gnomon.Model(pin)
    system, state = model.system, model.start()
    branch = system.switching(0, state.y) <= 0
    assert 0 < branch.sum() < branch.size
    other = ~branch
    at_start = system.residual(0, state.y, state.ydot)
    assert numpy.array_equal(system.residual(0, state.y, state.ydot, branch), at_start)
    assert not numpy.array_equal(system.residual(0, state.y, state.ydot, other), at_start)
    J = system.jacobian(0, state.y, state.ydot, 0.3, branch=other)
    direction = numpy.random.default_rng(2).standard_normal(system.size) * system.unknown_scale
    h = 1e-6
    ahead, behind = (system.residual(0, state.y + sign * h * direction, state.ydot + sign * h * 0.3 * direction, other)
                     for sign in (1, -1))
    difference = (ahead - behind) / (2 * h) / system.row_scale
    product = J @ direction / system.row_scale
    assert numpy.abs(product - difference).max() < 1e-5 * numpy.abs(product).max()
    with pytest.raises(gnomon.InputError, match="branch: expected"):
        system.residual(0, state.y, state.ydot, branch[1:])
    for wrong in (numpy.nan, 0.5, -1):
        with pytest.raises(gnomon.InputError, match=f"branch: expected ones.* got {wrong}"):
            system.residual(0, state.y, state.ydot, numpy.full(branch.size, wrong))


def test_within_continues_the_part_before_a_kink_in_time(pin):
    loaded = gnomon.Model(pin.with_({"load.times": [0.0, 10.0, 20.0], "load.factors": [1.0, 2.0, 2.0]}))
    system, state = loaded.system, loaded.start()
    at, continued, before = (system.residual(*arguments) for arguments in (
        (15, state.y, state.ydot), (15, state.y, state.ydot, None, 5), (10, state.y, state.ydot)))
    assert not numpy.allclose(at, continued, rtol=0, atol=1e-6)
    start = system.residual(5, state.y, state.ydot)  # the load is linear up to 10 s
    assert numpy.allclose(continued - before, before - start, rtol=0, atol=1e-9 * numpy.abs(before).max())


def test_blocks_share_out_the_unknowns(pin):
    model = gnomon.Model(pin)
    indices, system = model.system.indices, model.system
    assert {name: len(places) for name, places in indices.items()} == {
        block["name"]: block["size"] for block in model.blocks}
    assert numpy.array_equal(numpy.sort(numpy.concatenate(list(indices.values()))), numpy.arange(system.size))
    assert system.differential[indices["worn_surface"]].all()
    assert not system.differential[indices["displacement"]].any()
    assert model.error_scale > 0 and (system.tolerance_scale == 1).all()


def test_the_stages_solve_the_algebraic_rows(pin):
    """Newton's method on each stage, one after the other, as System.consistent does."""
    spsolve = pytest.importorskip("scipy.sparse.linalg").spsolve
    model = gnomon.Model(pin)
    system, state = model.system, model.start()
    y = state.y + 5 * state.ydot
    for stage in system.algebraic_stages():
        stage.freeze(5, y)
        assert len(stage.unknowns) == stage.system.size
        part = y[stage.unknowns]
        for _ in range(20):
            F = stage.system.residual(5, part)
            part = part - spsolve(stage.system.jacobian(5, part), F)
        y[stage.unknowns] = part
    rest = (system.residual(5, y, state.ydot) / system.row_scale)[~system.differential]
    assert numpy.abs(rest).max() < 1e-9
    expected = system.consistent(5, state.y + 5 * state.ydot).y
    assert numpy.abs(y - expected).max() < 1e-8 * numpy.abs(expected).max()


def test_a_system_counts_what_is_asked_of_it(pin):
    model = gnomon.Model(pin)
    system, state = model.system, model.start()
    assert system.counters["residual_evaluations"] == 0
    system.residual(0, state.y, state.ydot)
    system.jacobian(0, state.y, state.ydot, 1.0)
    assert system.counters["residual_evaluations"] == system.counters["jacobian_evaluations"] == 1
    system.consistent(1, state.y + state.ydot)
    assert model.system.counters["newton_iterations"] > 0
    with pytest.raises(gnomon.InputError, match="ydot: expected"):
        system.residual(0, state.y)
