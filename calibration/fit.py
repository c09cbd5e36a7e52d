"""Least squares without negative coefficients, and what a leave-one-out test says of them."""


def solve(matrix, right):
    """Solves matrix * x = right by elimination with pivoting. None if the matrix is singular."""
    n = len(matrix)
    rows = [list(map(float, matrix[i])) + [float(right[i])] for i in range(n)]
    for i in range(n):
        pivot = max(range(i, n), key=lambda k: abs(rows[k][i]))
        if abs(rows[pivot][i]) < 1e-12:
            return None
        rows[i], rows[pivot] = rows[pivot], rows[i]
        for k in range(i + 1, n):
            factor = rows[k][i] / rows[i][i]
            for j in range(i, n + 1):
                rows[k][j] -= factor * rows[i][j]
    x = [0.0] * n
    for i in reversed(range(n)):
        x[i] = (rows[i][n] - sum(rows[i][j] * x[j] for j in range(i + 1, n))) / rows[i][i]
    return x


def least_squares(samples, columns):
    """Coefficients of `columns` that fit `samples`, a list of (counts by column, total).

    What is minimised is the relative error. None if the samples do not tell the columns apart.
    """
    scale = {c: max((s[0].get(c, 0) / s[1] for s in samples), default=0) for c in columns}
    if any(value == 0 for value in scale.values()):
        return None
    normal = [[0.0] * len(columns) for _ in columns]
    right = [0.0] * len(columns)
    for counts, total in samples:
        row = [counts.get(c, 0) / total / scale[c] for c in columns]
        for i, a in enumerate(row):
            right[i] += a
            for j, b in enumerate(row):
                normal[i][j] += a * b
    x = solve(normal, right)
    return None if x is None else {c: x[i] / scale[c] for i, c in enumerate(columns)}


def fit(samples, columns):
    """As least_squares, but none negative: such columns get 0. Columns that no sample has, too."""
    used = [c for c in columns if any(s[0].get(c, 0) for s in samples)]
    while used:
        found = least_squares(samples, used)
        if found is None:
            used = used[:-1]  # the least important come last
            continue
        worst = min(used, key=lambda c: found[c])
        if found[worst] >= 0:
            return {c: found.get(c, 0.0) for c in columns}
        used.remove(worst)
    return {c: 0.0 for c in columns}


def predict(coefficients, counts):
    return sum(coefficients[c] * counts.get(c, 0) for c in coefficients)


def leave_one_out(samples, columns):
    """Relative errors, in %, of each sample predicted by a fit to the others."""
    errors = []
    for i, (counts, total) in enumerate(samples):
        coefficients = fit(samples[:i] + samples[i + 1:], columns)
        errors.append(100 * abs(predict(coefficients, counts) - total) / total)
    return errors
