% The time of a tick from Octave. FOLDER: of integrations/reference.py.
folder = getenv('FOLDER');
file = fopen([folder '/motion.f64'], 'r', 'ieee-le');
rows = fread(file, [9, Inf], 'double');
fclose(file);
p = rows(1:3, :); axes = rows(4:6, :);
n = columns(rows);
insertion = PuncturaInsertion(fileread([folder '/scene.toml']));
all_ticks = one = Inf;
for i = 1:20
  insertion.reset();
  start = tic; insertion.run(p, axes); all_ticks = min(all_ticks, toc(start));
end
for i = 1:5
  insertion.reset();
  start = cputime();  % not that of other programs
  for k = 1:10:n, insertion.step(p(:, k), axes(:, k)); end
  one = min(one, cputime() - start);
end
printf('Octave: run, all ticks in one call\t%.1f\n', 1e9 * all_ticks / n);
printf('Octave: step\t%.1f\n', 1e9 * one / (n / 10));
