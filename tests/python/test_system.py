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
