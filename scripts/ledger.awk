# Whether the energy ledger of a run closes to 1e-10 of the greatest of its parts: awk -F, -f scripts/ledger.awk RUN/steps.csv
NR == 1 { for (i = 1; i <= NF; i++) at[$i] = i; next }
{
    n = split("kinetic potential work dissipated", parts, " ")
    for (k = 1; k <= n; k++) { x = $at[parts[k]]; if (x < 0) x = -x; if (x > scale) scale = x }
    x = $at["balance_error"]; if (x < 0) x = -x; if (x > error) error = x
}
END {
    printf("%.1e of the energy\n", (scale > 0 ? error / scale : error))
    exit !(NR > 1 && error <= 1e-10 * scale)
}
