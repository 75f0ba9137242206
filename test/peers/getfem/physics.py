#!/usr/bin/env python3
"""Three coupled problems for GetFEM (Debian 12: apt-get install python3-getfem).

    physics.py        writes physics.csv, what testGetfem.cpp compares with; a few seconds

Same cells (biquadratic, 8 x 4 on 2 x 1) and cubature (3 x 3 points of Gauss) as the decks there, so that the discrete
problems are the same; GetFEM differentiates the weak forms, or the energy, by itself.
"""
import os

import getfem as gf
import numpy as np

LEFT, RIGHT, BOTTOM, TOP = 1, 2, 3, 4
PLACES = ((0.5, 0.5), (1.0, 1.0), (1.5, 0.75), (2.0, 1.0))


def plate():
    mesh = gf.Mesh("cartesian", np.linspace(0, 2, 9), np.linspace(0, 1, 5))
    outer = mesh.outer_faces()
    normals = mesh.normal_of_faces(outer)
    for region, normal in ((LEFT, (-1, 0)), (RIGHT, (1, 0)), (BOTTOM, (0, -1)), (TOP, (0, 1))):
        mesh.set_region(region, outer[:, np.dot(normal, normals) > 0.99])
    return mesh, gf.MeshIm(mesh, gf.Integ("IM_GAUSS_PARALLELEPIPED(2,5)"))


def field(mesh, size=1):
    mf = gf.MeshFem(mesh, size)
    mf.set_fem(gf.Fem("FEM_QK(2,2)"))
    return mf


def solve(model):
    model.solve("max_res", 1e-13, "max_iter", 60)


def at(mf, values, rows, name):
    """Values at the nodes that stand at PLACES; of vectors x and y, whose unknowns follow each other."""
    nodes, size = mf.basic_dof_nodes(), mf.qdim()
    for x, y in PLACES:
        here = np.where((abs(nodes[0] - x) < 1e-9) & (abs(nodes[1] - y) < 1e-9))[0]
        assert len(here) == size
        for component, dof in zip([""] if size == 1 else "xy", here):
            rows.append((name + component, x, y, values[dof]))


def bratu(rows):
    """-lap u = 3 exp(u), u = 0 on the rim: the lower branch."""
    mesh, mim = plate()
    u = field(mesh)
    model = gf.Model("real")
    model.add_fem_variable("u", u)
    model.add_nonlinear_term(mim, "Grad_u.Grad_Test_u - 3*exp(u)*Test_u")
    for side in (LEFT, RIGHT, BOTTOM, TOP):
        model.add_Dirichlet_condition_with_simplification("u", side)
    solve(model)
    at(u, model.variable("u"), rows, "bratu,u")


def conductor(rows):
    """A current through a plate that heats it; conductivities fall with the temperature; the top radiates."""
    mesh, mim = plate()
    T, V = field(mesh), field(mesh)
    model = gf.Model("real")
    model.add_fem_variable("T", T)
    model.add_fem_variable("V", V)
    model.set_variable("T", np.ones(T.nbdof()))
    model.add_initialized_data("one", [1.0])
    model.add_initialized_data("pole", [2.0])
    sigma = "(5/(1 + 0.3*T))"
    model.add_nonlinear_term(mim, sigma + "*Grad_V.Grad_Test_V")
    model.add_nonlinear_term(
        mim, "(1 + 0.1*T)*Grad_T.Grad_Test_T - " + sigma + "*(Grad_V.Grad_V)*Test_T")
    model.add_nonlinear_term(mim, "-(0.5*(1 - T) + 0.1*(1 - pow(T,4)))*Test_T", TOP)
    for side in (BOTTOM, LEFT):
        model.add_Dirichlet_condition_with_simplification("T", side, "one")
    model.add_Dirichlet_condition_with_simplification("V", LEFT)
    model.add_Dirichlet_condition_with_simplification("V", RIGHT, "pole")
    solve(model)
    at(T, model.variable("T"), rows, "conductor,T")
    at(V, model.variable("V"), rows, "conductor,V")


def dielectric(rows):
    """A neo-Hookean plate in plane strain, held at its left end, with a voltage of 0.5 through its thickness."""
    mesh, mim = plate()
    u, phi = field(mesh, 2), field(mesh)
    model = gf.Model("real")
    model.add_fem_variable("u", u)
    model.add_fem_variable("phi", phi)
    model.add_initialized_data("top", [0.1])
    F = "(Id(2) + Grad_u)"
    J = f"Det({F})"
    model.add_nonlinear_term(
        mim, f"0.5*(Norm_sqr({F}) - 2) - log({J}) + sqr(log({J})) - 0.5*{J}*Norm_sqr((Inv({F}))'*Grad_phi)")
    model.add_Dirichlet_condition_with_simplification("u", LEFT)
    model.add_Dirichlet_condition_with_simplification("phi", BOTTOM)
    model.add_Dirichlet_condition_with_simplification("phi", TOP, "top")
    for voltage in (0.1, 0.2, 0.3, 0.4, 0.5):
        model.set_variable("top", [voltage])
        solve(model)
    at(u, model.variable("u"), rows, "dielectric,u")
    at(phi, model.variable("phi"), rows, "dielectric,phi")


if __name__ == "__main__":
    found = []
    for problem in (bratu, conductor, dielectric):
        problem(found)
    with open(os.path.join(os.path.dirname(os.path.abspath(__file__)), "physics.csv"), "w") as file:
        file.write("problem,quantity,x,y,value\n")
        for name, x, y, value in found:
            file.write(f"{name},{x:g},{y:g},{value:.15g}\n")
