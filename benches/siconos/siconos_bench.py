#!/usr/bin/env python3
"""Times the solvers of Siconos on contact problems from files, and judges every answer itself.

    siconos_bench.py [--tolerance T] [--strict] [--seconds S] [--repeat N] [--out JSON] FILE...

The problem is u = W r + q, K* ∋ û ⊥ r ∈ K, û = u + (μ‖u_T‖ + μ_r‖u_R‖) n, interleaved by contact: [N, T] in 2D, [N, T1, T2] in
3D, [N, T1, T2, R1, R2] with rolling. A FILE is a text file of Siconos (.dat) or an HDF5 file of the FCLIB collection. A global
problem, M v = H r + f, u = Hᵀ v + w, is also reduced to W = Hᵀ M⁻¹ H, q = Hᵀ M⁻¹ f + w, and the solvers of both forms are tried
(in 2D Siconos has none for the global one). A Markdown table goes to standard output, everything else to JSON.

What a solver says of its own answer does not count. Two residuals are computed here from r alone,

    siconos = √Σ‖r_c − P_K(r_c − û_c)‖² / max(‖q‖, ‖r‖, ‖u‖)
    scaled  = √Σ e_c² / √Σ(‖q_c‖² + ‖u_c‖²),    e_c = w_c ‖r_c − P_K(r_c − û_c/w_c)‖,  w_c = tr(W_cc)/D

and r is a solution where both are at most T; at most 1e-6 where T is less and the file carries six or seven digits (--strict: T
all the same). As each solver stops by a measure of its own, it is asked for T, and for T/10, T/100, T/1e4 and T/1e6 as long as it
claims success and is wrong. All other options are those of Siconos, but the number of iterations, which is put out of reach: S
seconds are the limit. Each matrix is given dense, as sparse blocks and as sparse scalars, and the quickest counts.

`seconds` is the call of the driver alone, on one thread, on a problem newly read, the least of N (fewer where S/5 is spent), and
`cpu` the processor's time of the same call; reading and reducing are not counted. Each solve runs in a child process, as some end
in a crash and some never. Its reactions lie in shared memory, so that what was reached when the time was up is known too.

It needs siconos.numerics, NumPy, SciPy and h5py: Debian's python3-siconos, python3-scipy and python3-h5py.
"""

import argparse
import json
import mmap
import os
import re
import resource
import signal
import tempfile
import time
from pathlib import Path
from types import SimpleNamespace

os.environ.update(OPENBLAS_NUM_THREADS="1", OMP_NUM_THREADS="1")  # read once, when NumPy and Siconos load

import h5py
import numpy as np
import scipy
import scipy.sparse as sp
import scipy.sparse.linalg
import siconos
import siconos.numerics as sn

STORAGES = ("dense", "blocks", "sparse")  # in the order of the numbers that Siconos gives them
DENSE_LIMIT = 1000  # unknowns; a dense matrix is not worth a try above
TIGHTER = (1, 10, 100, 1e4, 1e6)
ENDLESS = 2_000_000_000  # iterations
MEMORY = 8 << 30  # bytes a child may take
LOADING = 60.0  # seconds in which a child must have read its problem

FUNCTIONS = {  # of Siconos: what reads a problem, what solves it
    ("local", 2): ("frictionContact", "fc2d"),
    ("local", 3): ("frictionContact", "fc3d"),
    ("global", 3): ("globalFrictionContact", "gfc3d"),
    ("local", 5): ("rollingFrictionContact", "rolling_fc3d"),
    ("global", 5): ("globalRollingFrictionContact", "g_rolling_fc3d"),
}

# What is tried. SOCLCP and IPM leave μ‖u_T‖ out: they solve another problem wherever a contact slides.
LOCAL = "NSGS NSGSV PROX TFP PFP ACLMFP SOCLCP DSFP FPP EG HP VI_FPP VI_EG ADMM NSN_AC NSN_AC_TEST NSN_FB NSN_NM".split()
GLOBAL = "NSGS_WR NSGSV_WR PROX_WR DSFP_WR TFP_WR NSN_AC_WR ADMM_WR NSGS NSN_AC VI_FPP VI_EG ACLMFP ADMM IPM".split()
ONE_CONTACT = ("QUARTIC QUARTIC_NU NSN NSN_GP ProjectionOnCone ProjectionOnConeWithLocalIteration "
               "ProjectionOnConeWithDiagonalization").split()  # besides NSN_GP_HYBRID, the default within NSGS


def candidates(p):
    """Each (form, solver, local solver) for problems like p; the local solver is None where it is the default or none."""
    if p.d == 2:
        return [("local", f"FRICTION_2D_{s}", None) for s in ("NSGS", "CPG", "LEMKE", "ENUM")]
    if p.d == 5:
        inner = [f"ROLLING_FRICTION_3D_ONECONTACT_ProjectionOnCone{s}" for s in ("", "WithLocalIteration")]
        tried = [("local", "ROLLING_FRICTION_3D_NSGS", i) for i in inner] + [("local", "ROLLING_FRICTION_3D_ADMM", None)]
        return tried + [("global", "GLOBAL_ROLLING_FRICTION_3D_NSGS_WR", i) for i in inner if p.whole]
    velocity = {s: "FRICTION_3D_ONECONTACT_ProjectionOnCone_velocity" for s in ("NSGSV", "NSGSV_WR")}  # takes no other
    tried = [("local", f"FRICTION_3D_{s}", velocity.get(s)) for s in LOCAL]
    tried += [("local", "FRICTION_3D_NSGS", f"FRICTION_3D_ONECONTACT_{s}") for s in ONE_CONTACT]
    return tried + [("global", f"GLOBAL_FRICTION_3D_{s}", velocity.get(s)) for s in GLOBAL if p.whole]


class Words:
    """The words of a text file, one after another."""

    def __init__(self, path):
        self.all, self.at, self.entries = path.read_text().split(), 0, []

    def take(self, n):
        self.at += n
        if self.at > len(self.all):
            raise ValueError("the file ends too early")
        return self.all[self.at - n : self.at]

    def ints(self, n):
        return np.array(self.take(n), dtype=int)

    def floats(self, n):
        return np.array(self.take(n), dtype=float)

    def values(self, *shape):
        """Values of a matrix column by column; how they are written is kept."""
        words = self.take(np.prod(shape))
        self.entries += words
        return np.array(words, dtype=float).reshape(shape, order="F")

    def matrix(self):
        storage, rows, cols = self.ints(3)
        if storage == 0:
            self.take(2)
            return sp.csr_matrix(self.values(rows, cols))
        i, j, x = [], [], []
        if storage == 1:
            blocks, across, down = self.ints(3)
            row_ends, col_ends = np.r_[0, self.ints(across)], np.r_[0, self.ints(down)]
            pointers, columns = (self.ints(n) for n in self.ints(2))
            for k in range(blocks):
                r, c = np.searchsorted(pointers, k, side="right") - 1, columns[k]
                self.take(1)  # the block's own number
                a = self.values(row_ends[r + 1] - row_ends[r], col_ends[c + 1] - col_ends[c])
                i += list(row_ends[r] + np.repeat(np.arange(a.shape[0]), a.shape[1]))
                j += list(col_ends[c] + np.tile(np.arange(a.shape[1]), a.shape[0]))
                x += list(a.ravel())
            return sp.csr_matrix((x, (i, j)), shape=(rows, cols))
        origin = self.ints(1)[0]
        while not re.fullmatch(r"\d+-by-\d+,", self.take(1)[0]):
            pass  # the name of the library that wrote it
        nonzeros = self.take(4)[3]
        if nonzeros.endswith(","):
            self.take(2)  # a norm
        for major in range((1, cols, rows)[origin - 1]):
            count = int(nonzeros.strip(","))
            if origin > 1:  # "col 3 : locations 7 to 9"
                first, _, last = self.take(7)[4:]
                count = int(last) - int(first) + 1
            for _ in range(count):
                place = [int(k) for k in self.take(2 if origin == 1 else 1)] + [major]
                self.take(1)  # a colon
                row, col = (place[1], place[0]) if origin == 3 else place[:2]
                i.append(row), j.append(col), x.append(self.values(1)[0])
        return sp.csr_matrix((x, (i, j)), shape=(rows, cols))


def read_text(path, whole):
    words = Words(path)
    d, nc = (int(k) for k in words.ints(2))
    p = SimpleNamespace(d=d, nc=nc, whole=None, mu_r=None)
    if whole:
        m, h = words.matrix(), words.matrix()
        p.whole = m, h, words.floats(m.shape[0]), words.floats(d * nc)
    else:
        p.W, p.q = words.matrix(), words.floats(d * nc)
    p.mu = words.floats(nc)
    if d == 5:
        p.mu_r = words.floats(nc)
    if len(words.all) > words.at + 1:
        raise ValueError("words are left over")
    p.rounded = max(len(re.sub(r"[eE].*|\D", "", w).strip("0")) for w in words.entries) in (6, 7)  # %g and %e
    return p


def read_hdf5(path):
    def matrix(group):
        nz, m, n = (int(group[k][0]) for k in ("nz", "m", "n"))
        i, p, x = (group[k][()] for k in "ipx")
        if nz >= 0:
            return sp.csr_matrix((x[:nz], (i[:nz], p[:nz])), shape=(m, n))
        return sp.csr_matrix({-2: sp.csr_matrix, -1: sp.csc_matrix}[nz]((x, i, p), shape=(m, n)))

    with h5py.File(path) as file:
        root = next(group for name, group in file.items() if name.startswith("fclib_"))
        v = {name: data[()] for name, data in root["vectors"].items()}
        p = SimpleNamespace(d=int(root["spacedim"][0]), nc=len(v["mu"]), mu=v["mu"], mu_r=v.get("mu_r"), rounded=False)
        p.whole = None if "W" in root else (matrix(root["M"]), matrix(root["H"]), v["f"], v["w"])
        if not p.whole:
            p.W, p.q = matrix(root["W"]), v["q"]
    return p


def read(path):
    """The problem in a file; its W and q also where it is global."""
    if path.suffix != ".dat":
        p = read_hdf5(path)
    else:
        try:
            p = read_text(path, whole=False)
        except (ValueError, IndexError):  # nothing in a text file tells the forms apart but how it goes on
            p = read_text(path, whole=True)
    if p.whole:
        m, h, f, w = p.whole
        lu = sp.linalg.splu(sp.csc_matrix(m))
        p.W, p.q = sp.csr_matrix(h.T @ lu.solve(h.toarray())), h.T @ lu.solve(f) + w
    return p


def project(p, z):
    """The nearest points of the cones; a row of z is a contact.

    The nearest normal part n is where n − z_N = Σ μ_i max(t_i − μ_i n, 0), or 0 if that is less; t_i is the length of a part, the
    tangential or the rolling one. The right side is the greatest of the sums over subsets, so the root is the greatest root.
    """
    parts = [(mu, x, np.linalg.norm(x, axis=1)) for mu, x in ((p.mu, z[:, 1:3]), (p.mu_r, z[:, 3:5])) if x.size]
    n = np.maximum(z[:, 0], 0.0)
    for subset in range(1, 1 << len(parts)):
        taken = [(mu, t) for k, (mu, _, t) in enumerate(parts) if subset >> k & 1]
        n = np.maximum(n, (z[:, 0] + sum(mu * t for mu, t in taken)) / (1.0 + sum(mu**2 for mu, _ in taken)))
    shrunk = [x * np.minimum(1.0, mu * n / np.where(t > 0.0, t, 1.0))[:, None] for mu, x, t in parts]
    return np.hstack([n[:, None], *shrunk])


def residuals(p, r):
    norm, u, shape = np.linalg.norm, p.W @ r + p.q, (p.nc, p.d)
    rows, hat = r.reshape(shape), u.reshape(shape).copy()
    hat[:, 0] += p.mu * norm(hat[:, 1:3], axis=1)
    if p.d == 5:
        hat[:, 0] += p.mu_r * norm(hat[:, 3:5], axis=1)
    w = p.W.diagonal().reshape(shape).mean(axis=1, keepdims=True)
    w[w <= 0.0] = 1.0  # a contact that nothing moves
    plain = norm(rows - project(p, rows - hat)) / (max(norm(p.q), norm(r), norm(u)) or 1.0)
    scaled = norm(w * (rows - project(p, rows - hat / w))) / (np.hypot(norm(p.q), norm(u)) or 1.0)
    return {"siconos": float(plain), "scaled": float(scaled)}


def write(p, form, storage, path):
    """The problem as Siconos reads it, to the last bit."""
    with open(path, "w") as out:
        line = lambda numbers: out.write(" ".join(f"{x:.17g}" for x in numbers) + "\n")

        def matrix(a, block):
            line((STORAGES.index(storage),) + a.shape)
            if storage == "dense":
                line(a.shape)
                line(a.toarray().ravel(order="F"))
            elif storage == "blocks":
                b = sp.bsr_matrix(a, blocksize=block)
                b.sort_indices()
                line((len(b.indices), a.shape[0] // block[0], a.shape[1] // block[1]))
                line(range(block[0], a.shape[0] + 1, block[0]))
                line(range(block[1], a.shape[1] + 1, block[1]))
                line((len(b.indptr), len(b.indices)))
                line(b.indptr)
                line(b.indices)
                for k, values in enumerate(b.data):
                    line((k,))
                    line(values.ravel(order="F"))
            else:
                t = a.tocoo()
                out.write(f"1\nCSparse Version 3.1.9\ntriplet: {a.shape[0]}-by-{a.shape[1]}, nzmax: {t.nnz} nnz: {t.nnz}\n")
                out.writelines(f"{i} {j} : {x:.17g}\n" for i, j, x in zip(t.row, t.col, t.data))

        line((p.d, p.nc))
        if form == "local":
            matrix(p.W, (p.d, p.d))
            line(p.q)
        else:
            m, h, f, w = p.whole
            body = next(k for k in (6, 3, 1) if m.shape[0] % k == 0)
            matrix(m, (body, body))
            matrix(h, (body, p.d))
            line(f)
            line(w)
        line(p.mu)
        if p.d == 5:
            line(p.mu_r)


def solve(p, form, path, solver, inner, asked, seconds, repeat, head, r, u, v):
    """Runs in the child: what comes of it goes to the shared arrays."""
    reader, driver = FUNCTIONS[form, p.d]
    new, driver = getattr(sn, reader + "_new_from_filename"), getattr(sn, driver + "_driver")
    kept, all_spent = [], 0.0  # freeing an object that a solver has used can crash
    for k in range(repeat):
        if all_spent > seconds / 5:
            break
        problem, options = new(str(path)), sn.SolverOptions(getattr(sn, "SICONOS_" + solver))
        kept += problem, options
        if inner:
            sn.solver_options_update_internal(options, 0, getattr(sn, "SICONOS_" + inner))
        options.iparam[sn.SICONOS_IPARAM_MAX_ITER], options.dparam[sn.SICONOS_DPARAM_TOL] = ENDLESS, asked
        r[:] = u[:] = v[:] = 0.0
        head[1], cpu, start = time.monotonic(), time.process_time(), time.perf_counter()
        info = driver(problem, r, u, *([v] if form == "global" else []), options)
        spent, cpu = time.perf_counter() - start, time.process_time() - cpu
        all_spent += spent
        if k == 0 or spent < head[2]:
            head[2:] = spent, cpu, info, options.iparam[sn.SICONOS_IPARAM_ITER_DONE]
        head[0] = k + 1


def attempt(p, form, path, solver, inner, asked, seconds, repeat=1):
    """Solves in a child process and says how it went."""
    n, global_n = p.d * p.nc, p.whole[0].shape[0] if p.whole else 0
    head, r, u, v = np.split(np.frombuffer(mmap.mmap(-1, 8 * (6 + 2 * n + global_n))), [6, 6 + n, 6 + 2 * n])
    begun, child = time.monotonic(), os.fork()
    if child == 0:
        code = 1
        try:
            nowhere = os.open(os.devnull, os.O_WRONLY)
            os.dup2(nowhere, 1), os.dup2(nowhere, 2)
            resource.setrlimit(resource.RLIMIT_AS, (MEMORY, MEMORY))
            resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
            solve(p, form, path, solver, inner, asked, seconds, repeat, head, r, u, v)
            code = 0
        finally:
            os._exit(code)
    pause, ended = 1e-3, 0
    while not ended:
        time.sleep(pause)
        pause = min(2 * pause, 0.02)
        ended, status = os.waitpid(child, os.WNOHANG)
        if not ended and time.monotonic() > (head[1] + seconds if head[1] else begun + LOADING):
            os.kill(child, signal.SIGKILL)
            ended, status = os.waitpid(child, 0)[0], None
    out = {"asked": asked}
    if head[0]:
        out.update(status="stopped", seconds=head[2], cpu=head[3], info=int(head[4]), iterations=int(head[5]))
    elif status is None:
        out["status"] = "out of time"
    else:  # an error of Python or exit() against a signal
        out["status"] = "refused" if os.WIFEXITED(status) else "crashed"
    if np.isfinite(r).all() and out["status"] in ("stopped", "out of time"):
        with np.errstate(all="ignore"):
            found = residuals(p, r.copy())
        out.update({k: x for k, x in found.items() if np.isfinite(x)})
    return out


def trial(p, paths, form, solver, inner, tolerance, seconds, repeat):
    """A solver on a problem: the quickest attempt that solves it, or else the nearest one."""
    worst = lambda a: max(a.get("siconos", np.inf), a.get("scaled", np.inf))
    tries = []
    for storage, path in paths[form].items():
        last = np.inf
        for factor in TIGHTER:
            a = attempt(p, form, path, solver, inner, tolerance / factor, seconds)
            a.update(storage=storage, solved=a["status"] == "stopped" and worst(a) <= tolerance)
            tries.append(a)
            if a["solved"] and repeat > 1 and a["seconds"] < seconds / 5:
                again = attempt(p, form, path, solver, inner, tolerance / factor, seconds, repeat)
                if again.get("seconds", np.inf) < a["seconds"]:
                    a.update({k: again[k] for k in ("seconds", "cpu")})
            if a["solved"] or a["status"] != "stopped" or a["info"] != 0:
                break
            if a["seconds"] > seconds / 20 and worst(a) > 0.5 * last:
                break  # dear and no better
            last = worst(a)
        if tries[-1]["status"] == "out of time":
            break  # the other storages hold the same numbers
    best = min(tries, key=lambda a: (not a["solved"], a["seconds"] if a["solved"] else worst(a)))
    name = solver.replace("FRICTION_", "") + (" " + inner.split("ONECONTACT_")[1] if inner else "")
    return {"solver": name, "form": form, "worst": min(worst(best), 1e300), **best, "tries": tries}


def main():
    options = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    options.add_argument("files", nargs="+", type=Path)
    options.add_argument("--tolerance", type=float, default=1e-8)
    options.add_argument("--strict", action="store_true")
    options.add_argument("--seconds", type=float, default=10.0)
    options.add_argument("--repeat", type=int, default=5)
    options.add_argument("--out", type=Path)
    args = options.parse_args()
    print("| problem | D | contacts | tolerance | solved by | quickest | seconds | cpu | siconos | scaled |")
    print("|---|---|---|---|---|---|---|---|---|---|", flush=True)
    problems = []
    for file in args.files:
        p = read(file)
        tolerance = max(args.tolerance, 1e-6) if p.rounded and not args.strict else args.tolerance
        with tempfile.TemporaryDirectory() as folder:
            paths = {"local": {}, "global": {}}
            for form in ("local", "global") if p.whole and p.d > 2 else ("local",):
                size = p.d * p.nc if form == "local" else p.whole[0].shape[0]
                for storage in ("blocks", "dense", "sparse"):
                    if storage != "dense" or size <= DENSE_LIMIT:
                        paths[form][storage] = Path(folder, f"{form}-{storage}.dat")
                        write(p, form, storage, paths[form][storage])
            found = [trial(p, paths, *c, tolerance, args.seconds, args.repeat) for c in candidates(p)]
        found.sort(key=lambda a: (not a["solved"], a["seconds"] if a["solved"] else a["worst"]))
        best = found[0]
        problems.append({"file": file.name, "dimension": p.d, "contacts": p.nc, "global": bool(p.whole), "tolerance": tolerance,
                         "at_rest": residuals(p, np.zeros(p.d * p.nc)), "solvers": found})
        print(f"| {file.stem} | {p.d} | {p.nc} | {tolerance:g} | {sum(a['solved'] for a in found)} of {len(found)} | "
              + (f"{best['solver']}, {best['form']}, {best['storage']} | {best['seconds']:.2g} | {best['cpu']:.2g}" if best["solved"]
                 else f"none; nearest {best['solver']}, {best['form']}, {best['storage']} | {best['status']} | ")
              + f" | {best.get('siconos', np.nan):.1e} | {best.get('scaled', np.nan):.1e} |", flush=True)
        if args.out:
            versions = {"siconos": siconos.version, "numpy": np.__version__, "scipy": scipy.__version__}
            settings = {"tolerance": args.tolerance, "strict": args.strict, "seconds": args.seconds, "repeat": args.repeat}
            args.out.write_text(json.dumps({"versions": versions, "settings": settings, "problems": problems}, indent=1))


if __name__ == "__main__":
    main()
