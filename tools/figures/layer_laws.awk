# Pressure [N/mm²] of a confined layer, E = 10 N/mm², ν = 0.45, by depth over thickness: condyle's two laws, and the Cauchy stress
# of a compressible neo-Hookean solid of the same E and ν under uniaxial strain.
BEGIN {
  E = 10; nu = 0.45
  K = E * (1 - nu) / ((1 + nu) * (1 - 2 * nu)); mu = E / (2 * (1 + nu)); lambda = K - 2 * mu
  print "| depth | `linear` | `logarithmic` | neo-Hookean |"
  print "|---|---|---|---|"
  split("0.05 0.1 0.2", depths, " ")
  for (i = 1; i <= 3; ++i) {
    d = depths[i]; stretch = 1 - d
    printf "| %g %% | %.2f | %.2f | %.2f |\n", 100 * d, K * d, -K * log(stretch), mu * (1 / stretch - stretch) - lambda * log(stretch) / stretch
  }
}
