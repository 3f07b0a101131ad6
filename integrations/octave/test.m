% Compares the forces with those of the core, bit for bit. FOLDER: of integrations/reference.py.
folder = getenv('FOLDER');
file = fopen([folder '/motion.f64'], 'r', 'ieee-le');
rows = fread(file, [9, Inf], 'double');
fclose(file);
text = fileread([folder '/scene.toml']);
p = rows(1:3, :); axes = rows(4:6, :); expected = rows(7:9, :);
n = columns(rows);

bits = @(x) typecast(x(:)', 'uint64');
a = PuncturaInsertion(text);
assert(bits(a.run(p, axes)), bits(expected));

b = PuncturaInsertion(text);
for k = 1:400
  if k == 300, kept = b.state(); end
  b.peek([1; 2; 3], axes(:, k));
  assert(bits(b.peek(p(:, k), axes(:, k))), bits(expected(:, k)));
  b.commit();
end
b.restore(kept);
for k = 300:400
  assert(bits(b.step(p(:, k), axes(:, k))), bits(expected(:, k)));
end
assert(all(isnan(b.step([NaN; 0; 0], [0; -1; 0]))));

function message = error_of(f)
  message = '';
  try
    f();
  catch e
    message = e.message;
  end
end
assert(! isempty(strfind(error_of(@() PuncturaInsertion(strrep(text, 'friction', 'frictoin'))), 'frictoin')));
assert(! isempty(strfind(error_of(@() b.restore(kept(1:end - 1))), 'bytes')));
assert(! isempty(strfind(error_of(@() b.run(p(1:2, :), axes)), '3 rows')));
assert(! isempty(strfind(error_of(@() b.commit()), 'no tick to commit')));  % not the older error
clear a b
printf('octave: %d forces equal the core''s bit for bit, also peeked and after a restored state\n', n);
